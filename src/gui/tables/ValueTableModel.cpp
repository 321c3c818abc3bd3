// SPDX-License-Identifier: Apache-2.0
#include "ValueTableModel.h"

#include "QPlcTimeAxis.h"
#include "gui/models/SiPrefix.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

/// Numbers stand at the right, as their titles.
QVariant alignmentOf(int column)
{
    const bool isNumber = column == ValueTableModel::Value || column == ValueTableModel::Minimum
        || column == ValueTableModel::Maximum || column == ValueTableModel::Age || column == ValueTableModel::Rate;
    return int(Qt::AlignVCenter | (isNumber ? Qt::AlignRight : Qt::AlignLeft));
}

}  // namespace

ValueTableModel::ValueTableModel(QPlcPanelContext *context, QObject *parent)
    : QAbstractTableModel(parent)
    , m_context(context)
{
    m_timer.setInterval(RefreshPause);
    connect(&m_timer, &QTimer::timeout, this, &ValueTableModel::refresh);
    connect(context, &QPlcPanelContext::signalsChanged, this, &ValueTableModel::resolve);
    connect(context->timeAxis(), &QPlcTimeAxis::displayTimeChanged, this, &ValueTableModel::refresh);
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
    Row row;
    row.reference = reference;
    row.signal = m_context->shown(reference.toString());
    row.past = m_context->past(reference.toString());
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
        const QPlcPast before = row.past;
        row.past = m_context->past(row.reference.toString());
        if (!row.past || !before || row.past.plant != before.plant)
            forgetRange(&row);
        else if (!row.past.sharesRows(before))
            row.seen = 0;  // other rows have other numbers
    }
    refresh();
}

// ---- values ----

void ValueTableModel::forgetRange(Row *row)
{
    row->range = QPlcPast::Range::empty();
    row->seen = row->past && !row->past.isEmpty() ? row->past.endRow() - 1 : 0;  // what is seen at the moment counts
}

void ValueTableModel::reset()
{
    for (Row &row : m_rows)
        forgetRange(&row);
    refresh();
}

void ValueTableModel::extendRange(Row *row)
{
    if (!row->past)
        return;
    row->range = row->range.united(row->past.range(std::max(row->seen, row->past.firstRow()), row->past.endRow()));
    row->seen = row->past.endRow();
}

bool ValueTableModel::isTrusted(const Row &row) const
{
    return m_context->shownTime() ? row.signal.value.isValid() : row.signal.isCurrent;
}

/// Nothing sorts before all numbers.
QVariant ValueTableModel::sortValue(const Row &row, int column) const
{
    const auto number = [](double value) { return std::isnan(value) ? QVariant() : QVariant(value); };
    if (column == Minimum || column == Maximum)
        return number(column == Minimum ? row.range.minimum : row.range.maximum);
    if (!row.signal)
        return column == Name || column == QualityColumn ? QVariant(row.texts.at(column)) : QVariant();
    if (column == Age)
        return row.signal.age;
    if (column == Rate)
        return m_context->plant(row.signal.plant).rate;
    const QPlcValue value = column == Value ? row.signal.value : QPlcValue();
    return value.isValid() && value.type().isNumeric() ? number(value.toReal()) : QVariant(row.texts.at(column));
}

QString ValueTableModel::qualityText(const QPlcPanelContext::Signal &signal) const
{
    if (m_context->shownTime())
        return signal.value.isValid() ? tr("past") : tr("no value");
    const QPlcPanelContext::Plant plant = m_context->plant(signal.plant);
    if (plant.age < 0.0)
        return tr("no value");
    if (!plant.isLive)  // at rest no value is of now
        return plant.isStale ? tr("stale") : tr("at rest");
    switch (signal.quality.kind()) {
    case QPlcQuality::Good:
        break;
    case QPlcQuality::Held:
        return tr("held %1").arg(signal.quality.heldCycles());
    case QPlcQuality::Safe:
        return tr("safe");
    case QPlcQuality::Invalid:
        return tr("not written");
    }
    return tr("good");
}

QStringList ValueTableModel::textsOf(const Row &row) const
{
    const QString name = row.reference.toString();
    if (!row.signal)
        return {name, {}, {}, {}, {}, tr("not there"), {}, {}};
    const QPlcValue &value = row.signal.value;
    const QPlcSignalDefinition &definition = row.signal.definition;
    // One prefix for the line: that of its largest number.
    const bool isNumber = value.isValid() && value.type().isReal() && !value.type().isArray();
    double largest = isNumber ? std::abs(value.toReal()) : 0.0;
    if (isNumber && !row.range.isEmpty())
        largest = std::max({largest, std::abs(row.range.minimum), std::abs(row.range.maximum)});
    const SiPrefix prefix = SiPrefix::fitting(definition.unit, largest);
    const auto rangeText = [&](double end) { return row.past ? numberText(prefix.shown(end)) : QString(); };
    const double rate = m_context->plant(row.signal.plant).rate;
    return {name,
            prefix.factor() == 1.0 ? valueText(value, definition) : numberText(prefix.shown(value.toReal())),
            prefix.unit(),
            rangeText(row.range.minimum),
            rangeText(row.range.maximum),
            qualityText(row.signal),
            ageText(row.signal.age),
            rate > 0.0 ? QStringLiteral("%1 Hz").arg(rate, 0, 'g', 3) : QString()};
}

void ValueTableModel::refresh()
{
    for (int i = 0; i < m_rows.size(); ++i) {
        Row &row = m_rows[i];
        row.signal = m_context->shown(row.reference.toString());
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
    if (row.signal)
        texts << row.signal.definition.unit << row.signal.definition.description << row.signal.writer
              << row.signal.plant;
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
        return row.signal ? row.signal.definition.description : row.signal.problem;
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
