// SPDX-License-Identifier: Apache-2.0
#include "NodeTableModel.h"

#include "ValueFormat.h"
#include "node/state/StateText.h"

#include <algorithm>

namespace qplc {

namespace {

bool isDuration(int column)
{
    return column >= NodeTableModel::LatenessP99 && column <= NodeTableModel::RoundTripMaximum;
}

QVariant figure(const QPlcDistribution &figures, qint64 value)
{
    return figures.count > 0 ? QVariant(double(value)) : QVariant();
}

QString healthText(NodeTableModel::HealthLevel level)
{
    switch (level) {
    case NodeTableModel::Good:
        return NodeTableModel::tr("OK");
    case NodeTableModel::Warning:
        return NodeTableModel::tr("Warning");
    case NodeTableModel::Error:
        return NodeTableModel::tr("Error");
    case NodeTableModel::Unavailable:
        break;
    }
    return NodeTableModel::tr("Unavailable");
}

/// The state, and whether the node keeps up.
QString stateOf(const NodeStatus &node)
{
    if (node.info.listener && !node.isLatched())
        return NodeTableModel::tr("Listens");
    const QString state = stateText(node.info.state);
    if (node.isLate)
        return NodeTableModel::tr("%1, late").arg(state);
    return node.statistics.late == 0 ? state : NodeTableModel::tr("%1, was late").arg(state);
}

}  // namespace

NodeTableModel::NodeTableModel(PlantList *plants, QObject *parent)
    : QAbstractTableModel(parent)
    , m_plants(plants)
{
    plants->forEach(this, &NodeTableModel::add);
    connect(plants, &PlantList::removed, this, &NodeTableModel::remove);
    connect(plants, &PlantList::added, this, &NodeTableModel::tellNames);
    connect(plants, &PlantList::removed, this, &NodeTableModel::tellNames);
}

void NodeTableModel::add(Plant *plant)
{
    update(plant);
    connect(plant, &Plant::statusChanged, this, [this, plant] { update(plant); });
    connect(plant, &Plant::stateChanged, this, [this, plant] { update(plant); });
}

void NodeTableModel::remove(Plant *plant)
{
    plant->disconnect(this);
    const auto isOf = [&](const Row &row) { return row.plant == plant; };
    const int first = firstRowOf(plant);
    const int count = int(std::count_if(m_rows.begin(), m_rows.end(), isOf));
    if (count == 0)
        return;
    beginRemoveRows({}, first, first + count - 1);
    m_rows.remove(first, count);
    endRemoveRows();
}

/// Names tell the plant where there are several.
void NodeTableModel::tellNames()
{
    if (!m_rows.isEmpty())
        Q_EMIT dataChanged(index(0, Name), index(m_rows.size() - 1, Name));
}

QString NodeTableModel::nameOf(const Row &row) const
{
    return m_plants->size() > 1 ? row.plant->name() + QLatin1Char('/') + row.node.info.name : row.node.info.name;
}

/// Whoever is missed keeps his row: who is evicted, nodes of a master that is lost, and nodes that
/// have left in the middle of the work.
void NodeTableModel::appendLost(Plant *plant, QVector<Row> *rows) const
{
    NodeStatus lost;
    for (const messages::EvictedEntry &entry : plant->status().master.evicted) {
        if (plant->status().node(entry.name))
            continue;  // for a moment: its connections are ending
        lost.info.name = entry.name;
        rows->append({plant, false, lost, evictedText(entry, QDate::currentDate()), {}, false});
    }
    for (const QString &name : plant->status().gone) {
        if (plant->status().evicted(name))
            continue;
        lost.info.name = name;
        rows->append({plant, false, lost, tr("gone"), {}, false});
    }
    const bool isAnswered = plant->isConnected() && plant->status().master.period.count() > 0;
    if (isAnswered)
        return;
    for (const Row &row : m_rows) {
        if (row.plant != plant || row.isMaster || row.node.info.listener || plant->status().evicted(row.node.info.name))
            continue;
        lost.info.name = row.node.info.name;
        rows->append({plant, false, lost, tr("not known"), {}, false});
    }
}

QVector<NodeTableModel::Row> NodeTableModel::rowsOf(Plant *plant) const
{
    const PlantStatus &status = plant->status();
    NodeStatus master;
    master.info.name = tr("Master");
    master.info.address = plant->address();
    master.statistics.execution = status.statistics.execution;
    master.statistics.roundTrip = status.statistics.roundTrip;
    QVector<Row> rows{{plant, true, master, stateWord(*plant), status.statistics.lateness, true}};
    for (const NodeStatus &node : status.nodes)
        rows.append({plant, false, node, stateOf(node), {}, true});
    appendLost(plant, &rows);
    return rows;
}

/// Late now is a warning, answers as cycles; when time stands still because of it, or nothing moves
/// until somebody resets it, an error.
NodeTableModel::HealthLevel NodeTableModel::healthOf(const Row &row)
{
    if (!row.isThere || !row.plant->isConnected() || row.plant->status().master.state == messages::MasterState::Unknown)
        return Unavailable;
    const PlantStatus &status = row.plant->status();
    const bool isWaiting = status.master.state == messages::MasterState::WaitingForLateSlaves;
    if (row.isMaster)
        return isWaiting || status.isLatched() ? Error : status.isOverrunning ? Warning : Good;
    if (row.node.isLatched())
        return Error;
    return !row.node.isLate ? Good : isWaiting ? Error : Warning;
}

/// Where the rows of a plant begin, or would.
int NodeTableModel::firstRowOf(const Plant *plant) const
{
    const auto found = std::find_if(m_rows.begin(), m_rows.end(), [&](const Row &row) { return row.plant == plant; });
    return int(found - m_rows.begin());
}

void NodeTableModel::update(Plant *plant)
{
    const QVector<Row> now = rowsOf(plant);
    const int first = firstRowOf(plant);
    int before = 0;
    while (first + before < m_rows.size() && m_rows.at(first + before).plant == plant)
        ++before;
    // Rows stay with their names: a node that leaves takes its row along, a new one comes behind.
    for (int row = before - 1; row > 0; --row) {
        const QString name = m_rows.at(first + row).node.info.name;
        if (std::any_of(now.begin() + 1, now.end(), [&](const Row &other) { return other.node.info.name == name; }))
            continue;
        beginRemoveRows({}, first + row, first + row);
        m_rows.remove(first + row);
        endRemoveRows();
        --before;
    }
    for (const Row &row : now) {
        const auto end = m_rows.begin() + first + before;
        const auto place = std::find_if(m_rows.begin() + first, end, [&](const Row &other) {
            return other.isMaster == row.isMaster && other.node.info.name == row.node.info.name;
        });
        const int at = int(place - m_rows.begin());
        if (place != end) {
            *place = row;
            Q_EMIT dataChanged(index(at, 0), index(at, ColumnCount - 1));
            continue;
        }
        beginInsertRows({}, at, at);
        m_rows.insert(at, row);
        endInsertRows();
        ++before;
    }
}

NodeEviction NodeTableModel::evictionOf(const QModelIndex &index) const
{
    if (!index.isValid())
        return {};
    const Row &row = m_rows.at(index.row());
    const QString person = PlantConnection::personOf(row.node.info);
    return {row.plant, row.isMaster ? QString() : person.isEmpty() ? row.node.info.name : person};
}

int NodeTableModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : m_rows.size();
}

int NodeTableModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(ColumnCount);
}

QVariant NodeTableModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    static const char *const titles[ColumnCount]
        = {QT_TR_NOOP("Plant"),          QT_TR_NOOP("Name"),           QT_TR_NOOP("Health"),
           QT_TR_NOOP("Transport"),      QT_TR_NOOP("Address"),        QT_TR_NOOP("Policy"),
           QT_TR_NOOP("State"),          QT_TR_NOOP("Lateness p99"),   QT_TR_NOOP("Execution p50"),
           QT_TR_NOOP("Execution p99"),  QT_TR_NOOP("Execution max"),  QT_TR_NOOP("Round trip p50"),
           QT_TR_NOOP("Round trip p99"), QT_TR_NOOP("Round trip max"), QT_TR_NOOP("Late"),
           QT_TR_NOOP("Lost"),           QT_TR_NOOP("Duplicated"),     QT_TR_NOOP("Rejected"),
           QT_TR_NOOP("Forged")};
    if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
        return {};
    if (role == Qt::DisplayRole)
        return tr(titles[section]);
    if (role == Qt::TextAlignmentRole)
        return int(Qt::AlignVCenter | (section >= LatenessP99 ? Qt::AlignRight : Qt::AlignLeft));
    if (role == Qt::ToolTipRole && isDuration(section))
        return section == ExecutionMaximum || section == RoundTripMaximum ? tr("since the start of the phase")
                                                                          : tr("over the last 10 s");
    return {};
}

QVariant NodeTableModel::number(const Row &row, int column)
{
    const QPlcNodeStatistics &node = row.node.statistics;
    const bool isCounted = row.isThere && !row.isMaster;
    switch (column) {
    case LatenessP99:
        return figure(row.lateness.last10s, row.lateness.last10s.p99);
    case ExecutionP50:
        return figure(node.execution.last10s, node.execution.last10s.p50);
    case ExecutionP99:
        return figure(node.execution.last10s, node.execution.last10s.p99);
    case ExecutionMaximum:
        return figure(node.execution.sinceStart, node.execution.sinceStart.maximum);
    case RoundTripP50:
        return figure(node.roundTrip.last10s, node.roundTrip.last10s.p50);
    case RoundTripP99:
        return figure(node.roundTrip.last10s, node.roundTrip.last10s.p99);
    case RoundTripMaximum:
        return figure(node.roundTrip.sinceStart, node.roundTrip.sinceStart.maximum);
    case Late:
        return isCounted ? node.late : QVariant();
    case Lost:
        return isCounted ? node.lost : QVariant();
    case Duplicated:
        return isCounted ? node.duplicated : QVariant();
    case Rejected:
        return isCounted ? node.rejected : QVariant();
    case Forged:
        return isCounted ? node.forged : QVariant();
    default:
        return {};
    }
}

QString NodeTableModel::text(const Row &row, int column) const
{
    switch (column) {
    case PlantColumn:
        return row.plant->name();
    case Name:
        return nameOf(row);
    case Health:
        return healthText(healthOf(row));
    case Transport:
        return transportText(row.node.info);
    case Address:
        return row.node.info.address;
    case Policy:
        return row.node.info.policy;
    case State:
        return row.state;
    default:
        break;
    }
    const QVariant value = number(row, column);
    if (!value.isValid())
        return {};
    return isDuration(column) ? durationText(value.toDouble()) : value.toString();
}

QVariant NodeTableModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Row &row = m_rows.at(index.row());
    switch (role) {
    case Qt::DisplayRole:
        return text(row, index.column());
    case Qt::ToolTipRole:
        if (row.isMaster && index.column() == State)
            return row.plant->stateText();
        return index.column() < LatenessP99 ? text(row, index.column()) : QString();
    case HealthRole:
        return int(healthOf(row));
    case SortRole: {
        if (index.column() == Health)
            return int(healthOf(row));
        const QVariant value = number(row, index.column());
        return value.isValid() || index.column() >= LatenessP99 ? value : text(row, index.column());
    }
    case Qt::TextAlignmentRole:
        return index.column() >= LatenessP99 ? QVariant(int(Qt::AlignRight | Qt::AlignVCenter)) : QVariant();
    case Qt::ForegroundRole:
        return foregroundOf(row.isThere && row.plant->isConnected());
    default:
        return {};
    }
}

}  // namespace qplc
