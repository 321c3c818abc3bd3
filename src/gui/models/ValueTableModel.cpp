// SPDX-License-Identifier: Apache-2.0
#include "ValueTableModel.h"

#include "SiPrefix.h"
#include "gui/plant/PastValue.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

/// Numbers stand at the right, as their titles.
QVariant alignmentOf(int column)
{
    const bool isNumber = column == ValueTableModel::Value || column == ValueTableModel::Minimum
        || column == ValueTableModel::Maximum || column == ValueTableModel::Age || column == ValueTableModel::Rate;
    return int(Qt::AlignVCenter | (isNumber ? Qt::AlignRight : Qt::AlignLeft));
}

/// Time since the newest value was true [s]; -1: it never was, or nobody knows.
double ageOf(const PlantList::Signal &signal)
{
    const double age = signal.plant->age();
    const QPlcQuality quality = signal.quality();
    if (signal.plant->quality() != Plant::Good)
        return age;
    return age < 0.0 || !quality.isUsable()
        ? -1.0
        : age + quality.heldCycles() * double(signal.plant->values().period()) * 1e-9;
}

constexpr float noNumber = std::numeric_limits<float>::quiet_NaN();

}  // namespace

ValueTableModel::ValueTableModel(PlantList *plants, QObject *parent)
    : QAbstractTableModel(parent)
    , m_plants(plants)
{
    m_timer.setInterval(RefreshPause);
    connect(&m_timer, &QTimer::timeout, this, &ValueTableModel::refresh);
    connect(plants, &PlantList::signalsChanged, this, &ValueTableModel::resolve);
    const auto watch = [this](Plant *plant) {  // rows of another store are numbered anew
        connect(plant, &Plant::storeChanged, this, [this, plant] {
            for (Row &row : m_rows) {
                if (row.signal.plant == plant)
                    row.seen = 0;
            }
        });
    };
    connect(plants, &PlantList::added, this, watch);
    for (int i = 0; i < plants->size(); ++i)
        watch(plants->at(i));
    m_timer.start();
}

// ---- the choice ----

QVector<SignalReference> ValueTableModel::references() const
{
    QVector<SignalReference> references;
    for (const Row &row : m_rows)
        references << row.reference;
    return references;
}

ValueTableModel::Row ValueTableModel::makeRow(const SignalReference &reference) const
{
    Row row{reference, m_plants->resolve(reference, m_pin), noNumber, noNumber, 0, {}};
    forgetRange(&row);
    row.texts = textsOf(row);
    return row;
}

void ValueTableModel::setReferences(const QVector<SignalReference> &references)
{
    beginResetModel();
    m_rows.clear();
    for (const SignalReference &reference : references)
        m_rows << makeRow(reference);
    endResetModel();
}

void ValueTableModel::setPin(const QString &plant)
{
    m_pin = plant;
    resolve();
}

void ValueTableModel::add(const QVector<SignalReference> &references, int row)
{
    const QVector<SignalReference> there = this->references();
    QVector<SignalReference> missing;
    for (const SignalReference &reference : references) {
        if (!there.contains(reference) && !missing.contains(reference))
            missing << reference;
    }
    if (missing.isEmpty())
        return;
    const int place = row < 0 || row > m_rows.size() ? m_rows.size() : row;
    beginInsertRows({}, place, place + missing.size() - 1);
    for (int i = 0; i < missing.size(); ++i)
        m_rows.insert(place + i, makeRow(missing.at(i)));
    endInsertRows();
}

bool ValueTableModel::removeRows(int row, int count, const QModelIndex &parent)
{
    if (parent.isValid() || row < 0 || count <= 0 || row + count > m_rows.size())
        return false;
    beginRemoveRows(parent, row, row + count - 1);
    m_rows.remove(row, count);
    endRemoveRows();
    return true;
}

/// References may mean something else now.
void ValueTableModel::resolve()
{
    for (Row &row : m_rows) {
        const PlantList::Signal before = row.signal;
        row.signal = m_plants->resolve(row.reference, m_pin);
        if (row.signal.plant != before.plant || row.signal.index != before.index)
            forgetRange(&row);
    }
    refresh();
}

// ---- values ----

void ValueTableModel::forgetRange(Row *row) const
{
    row->minimum = noNumber;
    row->maximum = noNumber;
    const SignalStore *store = row->signal ? row->signal.plant->store() : nullptr;
    row->seen = store && !store->isEmpty() ? store->endRow() - 1 : 0;  // what is seen at the moment counts
}

void ValueTableModel::reset()
{
    for (Row &row : m_rows)
        forgetRange(&row);
    refresh();
}

void ValueTableModel::extendRange(Row *row)
{
    const int channel = row->signal.channel();
    const SignalStore *store = row->signal ? row->signal.plant->store() : nullptr;
    if (!store || channel == ChannelMap::NoChannel)
        return;
    const SignalStore::Range range = store->range(channel, std::max(row->seen, store->firstRow()), store->endRow());
    row->seen = store->endRow();
    if (range.isEmpty())
        return;
    row->minimum = std::isnan(row->minimum) ? range.minimum : std::min(row->minimum, range.minimum);
    row->maximum = std::isnan(row->maximum) ? range.maximum : std::max(row->maximum, range.maximum);
}

void ValueTableModel::setDisplayTime(std::optional<SignalStore::Time> time)
{
    if (time == m_displayTime)
        return;
    m_displayTime = time;
    refresh();
}

QPlcValue ValueTableModel::shownValue(const Row &row) const
{
    return m_displayTime ? pastValue(row.signal, *m_displayTime) : row.signal.value();
}

bool ValueTableModel::isTrusted(const Row &row) const
{
    if (!row.signal)
        return false;
    if (m_displayTime)
        return shownValue(row).isValid();
    return qplc::isTrusted(row.signal);
}

/// Nothing sorts before all numbers.
QVariant ValueTableModel::sortValue(const Row &row, int column) const
{
    const auto number = [](double value) { return std::isnan(value) ? QVariant() : QVariant(value); };
    if (column == Minimum || column == Maximum)
        return number(double(column == Minimum ? row.minimum : row.maximum));
    if (!row.signal)
        return column == Name || column == QualityColumn ? QVariant(row.texts.at(column)) : QVariant();
    if (column == Age)
        return ageOf(row.signal);
    if (column == Rate)
        return row.signal.plant->updateRate();
    const QPlcValue value = column == Value ? shownValue(row) : QPlcValue();
    return value.isValid() && value.type().isNumeric() ? number(value.toReal()) : QVariant(row.texts.at(column));
}

QStringList ValueTableModel::textsOf(const Row &row) const
{
    const QString name = row.reference.toString();
    if (!row.signal)
        return {name, {}, {}, {}, {}, tr("not there"), {}, {}};
    const Plant &plant = *row.signal.plant;
    const bool isPast = m_displayTime.has_value();
    const bool hasRange = row.signal.channel() != ChannelMap::NoChannel;
    const QPlcValue value = shownValue(row);
    const QPlcSignalDefinition &definition = row.signal.definition();
    // One prefix for the line: that of its largest number.
    const bool isNumber = value.isValid() && value.type().isReal() && !value.type().isArray();
    double largest = isNumber ? std::abs(value.toReal()) : 0.0;
    if (isNumber && hasRange && !std::isnan(row.minimum))
        largest = std::max({largest, std::abs(double(row.minimum)), std::abs(double(row.maximum))});
    const SiPrefix prefix = SiPrefix::fitting(definition.unit, largest);
    const auto rangeText = [&](float end) { return hasRange ? numberText(prefix.shown(double(end))) : QString(); };
    return {name,
            prefix.factor() == 1.0 ? valueText(value, definition) : numberText(prefix.shown(value.toReal())),
            prefix.unit(),
            rangeText(row.minimum),
            rangeText(row.maximum),
            !isPast              ? qualityText(row.signal)
                : isTrusted(row) ? tr("past")
                                 : tr("no value"),
            isPast ? QString() : ageText(ageOf(row.signal)),
            plant.updateRate() > 0.0 ? QStringLiteral("%1 Hz").arg(plant.updateRate(), 0, 'g', 3) : QString()};
}

void ValueTableModel::refresh()
{
    for (int i = 0; i < m_rows.size(); ++i) {
        Row &row = m_rows[i];
        if (row.signal)
            extendRange(&row);
        const QStringList texts = textsOf(row);
        const bool isTrustedNow = isTrusted(row);
        if (texts == row.texts && isTrustedNow == row.isTrusted)
            continue;
        row.texts = texts;
        row.isTrusted = isTrustedNow;
        Q_EMIT dataChanged(index(i, 0), index(i, ColumnCount - 1), {Qt::DisplayRole, Qt::ForegroundRole});
    }
}

// ---- the model ----

int ValueTableModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : m_rows.size();
}

int ValueTableModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(ColumnCount);
}

QVariant ValueTableModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    static const char *const titles[ColumnCount]
        = {QT_TR_NOOP("Signal"), QT_TR_NOOP("Value"),   QT_TR_NOOP("Unit"), QT_TR_NOOP("Min"),
           QT_TR_NOOP("Max"),    QT_TR_NOOP("Quality"), QT_TR_NOOP("Age"),  QT_TR_NOOP("Rate")};
    if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
        return {};
    if (role == Qt::TextAlignmentRole)
        return alignmentOf(section);
    if (role != Qt::DisplayRole)
        return {};
    return tr(titles[section]);
}

QString ValueTableModel::searchText(const Row &row)
{
    QStringList texts{row.reference.toString()};
    if (row.signal) {
        const QPlcSignalDefinition &definition = row.signal.definition();
        texts << definition.unit << definition.description << row.signal.plant->writer(row.signal.index)
              << row.signal.plant->name();
    }
    return texts.join(QLatin1Char('\n'));
}

QVariant ValueTableModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Row &row = m_rows.at(index.row());
    switch (role) {
    case Qt::DisplayRole:
        return row.texts.at(index.column());
    case SortRole:
        return sortValue(row, index.column());
    case SearchRole:
        return searchText(row);
    case Qt::ForegroundRole:
        return foregroundOf(row.isTrusted);
    case Qt::TextAlignmentRole:
        return alignmentOf(index.column());
    case Qt::ToolTipRole:
        return row.signal
            ? row.signal.definition().description
            : QStringLiteral("no plant of this window has a signal '%1' now").arg(row.reference.toString());
    default:
        return {};
    }
}

Qt::ItemFlags ValueTableModel::flags(const QModelIndex &index) const
{
    return index.isValid() ? Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren
                           : Qt::ItemIsDropEnabled;
}

QStringList ValueTableModel::mimeTypes() const
{
    return {signalsMimeType()};
}

QMimeData *ValueTableModel::mimeData(const QModelIndexList &indexes) const
{
    QVector<SignalReference> chosen;
    for (const QModelIndex &index : indexes) {
        if (!chosen.contains(m_rows.at(index.row()).reference))
            chosen << m_rows.at(index.row()).reference;
    }
    return chosen.isEmpty() ? nullptr : mimeDataOf(chosen).release();
}

bool ValueTableModel::dropMimeData(const QMimeData *data, Qt::DropAction action, int row, int,
                                   const QModelIndex &parent)
{
    const QVector<SignalReference> references = referencesIn(data);
    if (action != Qt::IgnoreAction)
        add(references, row < 0 && parent.isValid() ? parent.row() : row);
    return !references.isEmpty();
}

}  // namespace qplc
