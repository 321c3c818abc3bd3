// SPDX-License-Identifier: Apache-2.0
#include "SignalTreeModel.h"

#include "SiPrefix.h"
#include "gui/plant/PastValue.h"

#include <algorithm>

namespace qplc {

struct SignalTreeModel::Item
{
    enum Kind { Root, PlantItem, Writer, Signal, Element };

    Kind kind = Root;
    Item *parent = nullptr;
    std::vector<ItemPtr> children;
    Plant *plant = nullptr;
    QString writer;  // of a Writer
    QPlcSignalIndex signal = QPlcInvalidSignalIndex;
    int element = SignalReference::Whole;
    // What was shown last.
    QString value;
    SiPrefix prefix;
    QString age;
    Plant::Quality quality = Plant::NoValue;

    int row() const
    {
        const auto found = std::find_if(parent->children.begin(), parent->children.end(),
                                        [this](const ItemPtr &child) { return child.get() == this; });
        return int(found - parent->children.begin());
    }
};

SignalTreeModel::SignalTreeModel(PlantList *plants, QObject *parent)
    : QAbstractItemModel(parent)
    , m_plants(plants)
    , m_root(std::make_unique<Item>())
{
    m_timer.setInterval(RefreshPause);
    connect(&m_timer, &QTimer::timeout, this, &SignalTreeModel::refresh);
    plants->forEach(this, &SignalTreeModel::add);
    connect(plants, &PlantList::removed, this, &SignalTreeModel::remove);
    m_timer.start();
}

SignalTreeModel::~SignalTreeModel() = default;

// ---- plants and groups ----

void SignalTreeModel::add(Plant *plant)
{
    const int row = int(m_root->children.size());
    beginInsertRows({}, row, row);
    auto item = std::make_unique<Item>();
    item->kind = Item::PlantItem;
    item->parent = m_root.get();
    item->plant = plant;
    m_root->children.push_back(std::move(item));
    endInsertRows();
    rebuild(plant);
    connect(plant, &Plant::tableChanged, this, [this, plant] { rebuild(plant); });
    connect(plant, &Plant::writersChanged, this, [this, plant] { regroup(plant); });
    connect(plant, &Plant::stateChanged, this, [this, plant] {
        if (const Item *changed = itemOf(plant))
            Q_EMIT dataChanged(indexOf(changed), indexOf(changed, ColumnCount - 1));
    });
}

void SignalTreeModel::remove(Plant *plant)
{
    plant->disconnect(this);
    const Item *item = itemOf(plant);
    if (!item)
        return;
    const int row = item->row();
    forget(plant);
    beginRemoveRows({}, row, row);
    m_root->children.erase(m_root->children.begin() + row);
    endRemoveRows();
}

void SignalTreeModel::forget(const Plant *plant)
{
    for (auto item = m_lookedAt.begin(); item != m_lookedAt.end();)
        item = (*item)->plant == plant ? m_lookedAt.erase(item) : std::next(item);
}

/// The table of the plant is another one.
void SignalTreeModel::rebuild(Plant *plant)
{
    Item *item = itemOf(plant);
    forget(plant);
    if (!item->children.empty()) {
        beginRemoveRows(indexOf(item), 0, int(item->children.size()) - 1);
        item->children.clear();
        endRemoveRows();
    }
    for (int signal = 0; signal < plant->table().size(); ++signal)
        insertSignal(item, makeSignal(plant, QPlcSignalIndex(signal)), plant->writer(QPlcSignalIndex(signal)));
}

/// Moves those signals that are written by another node now; all others stay, with what is selected
/// and unfolded.
void SignalTreeModel::regroup(Plant *plant)
{
    Item *plantItem = itemOf(plant);
    std::vector<Item *> moving;
    for (const ItemPtr &group : plantItem->children) {
        for (const ItemPtr &signal : group->children) {
            if (plant->writer(signal->signal) != group->writer)
                moving.push_back(signal.get());
        }
    }
    for (Item *signal : moving)
        insertSignal(plantItem, takeSignal(signal), plant->writer(signal->signal));
}

SignalTreeModel::ItemPtr SignalTreeModel::takeSignal(Item *signal)
{
    Item *group = signal->parent;
    Item *plantItem = group->parent;
    const int row = signal->row();
    beginRemoveRows(indexOf(group), row, row);
    ItemPtr taken = std::move(group->children[std::size_t(row)]);
    group->children.erase(group->children.begin() + row);
    endRemoveRows();
    if (group->children.empty()) {
        const int groupRow = group->row();
        beginRemoveRows(indexOf(plantItem), groupRow, groupRow);
        plantItem->children.erase(plantItem->children.begin() + groupRow);
        endRemoveRows();
    }
    return taken;
}

/// In the order of the table.
void SignalTreeModel::insertSignal(Item *plantItem, ItemPtr signal, const QString &writer)
{
    Item *group = groupFor(plantItem, writer);
    const auto place = std::find_if(group->children.begin(), group->children.end(),
                                    [&](const ItemPtr &other) { return other->signal > signal->signal; });
    const int row = int(place - group->children.begin());
    beginInsertRows(indexOf(group), row, row);
    signal->parent = group;
    group->children.insert(place, std::move(signal));
    endInsertRows();
}

/// Nodes by name, and what nobody writes behind them.
SignalTreeModel::Item *SignalTreeModel::groupFor(Item *plantItem, const QString &writer)
{
    const auto isBehind = [&](const ItemPtr &group) {
        return group->writer.isEmpty() || (!writer.isEmpty() && group->writer >= writer);
    };
    const auto place = std::find_if(plantItem->children.begin(), plantItem->children.end(), isBehind);
    if (place != plantItem->children.end() && (*place)->writer == writer)
        return place->get();
    auto group = std::make_unique<Item>();
    group->kind = Item::Writer;
    group->parent = plantItem;
    group->plant = plantItem->plant;
    group->writer = writer;
    Item *made = group.get();
    const int row = int(place - plantItem->children.begin());
    beginInsertRows(indexOf(plantItem), row, row);
    plantItem->children.insert(place, std::move(group));
    endInsertRows();
    return made;
}

SignalTreeModel::ItemPtr SignalTreeModel::makeSignal(Plant *plant, QPlcSignalIndex index) const
{
    auto signal = std::make_unique<Item>();
    signal->kind = Item::Signal;
    signal->plant = plant;
    signal->signal = index;
    const QPlcSignalType type = plant->table().at(index).type;
    for (int element = 0; type.isArray() && element < type.count(); ++element) {
        auto child = std::make_unique<Item>();
        child->kind = Item::Element;
        child->parent = signal.get();
        child->plant = plant;
        child->signal = index;
        child->element = element;
        signal->children.push_back(std::move(child));
    }
    return signal;
}

/// Empty while the table has changed and the rows have not yet.
const QPlcSignalDefinition &SignalTreeModel::definitionOf(const Item *item)
{
    static const QPlcSignalDefinition none;
    const QPlcSignalTable &table = item->plant->table();
    return item->signal < table.size() ? table.at(item->signal) : none;
}

// ---- values ----

PlantList::Signal SignalTreeModel::signalOf(const Item *item) const
{
    return {item->plant, item->signal, item->element};
}

QPlcValue SignalTreeModel::shownValue(const Item *item) const
{
    return m_displayTime ? pastValue(signalOf(item), *m_displayTime) : signalOf(item).value();
}

namespace {

/// A real number with the prefix that fits; all else as it is.
QString prefixedText(const QPlcValue &value, const QPlcSignalDefinition &definition, SiPrefix *prefix)
{
    constexpr int digits = 4;
    if (prefix->tableUnit() != definition.unit)
        *prefix = SiPrefix(definition.unit);
    const bool isNumber = value.isValid() && value.type().isReal() && !value.type().isArray();
    if (isNumber)
        *prefix = prefix->kept(value.toReal());
    return !isNumber || prefix->factor() == 1.0 ? shortValueText(value, definition)
                                                : steadyNumberText(prefix->shown(value.toReal()), digits);
}

}  // namespace

/// Takes the present value. \return whether it looks different
bool SignalTreeModel::renew(Item *item) const
{
    const QPlcValue shown = shownValue(item);
    const QString shownUnit = item->prefix.unit();
    const QString value = prefixedText(shown, definitionOf(item), &item->prefix);
    const QString age = m_displayTime ? QString() : ageText(item->plant->age());
    const Plant::Quality quality = !m_displayTime ? item->plant->quality()
        : shown.isValid()                         ? Plant::Good
                                                  : Plant::NoValue;
    if (value == item->value && age == item->age && quality == item->quality && item->prefix.unit() == shownUnit)
        return false;
    item->value = value;
    item->age = age;
    item->quality = quality;
    return true;
}

void SignalTreeModel::setDisplayTime(std::optional<SignalStore::Time> time)
{
    if (time == m_displayTime)
        return;
    m_displayTime = time;
    refresh();
}

void SignalTreeModel::refresh()
{
    std::vector<Item *> changed;
    for (Item *item : qAsConst(m_lookedAt)) {
        if (renew(item))
            changed.push_back(item);
    }
    for (Item *item : changed)
        m_lookedAt.remove(item);  // who still shows it looks again
    announce(changed);
}

/// One range for each run of rows.
void SignalTreeModel::announce(const std::vector<Item *> &changed)
{
    struct Place
    {
        const Item *item;
        int row;
    };
    std::vector<Place> places;
    places.reserve(changed.size());
    for (const Item *item : changed)
        places.push_back({item, item->row()});
    std::sort(places.begin(), places.end(), [](const Place &a, const Place &b) {
        return a.item->parent == b.item->parent ? a.row < b.row : std::less<>()(a.item->parent, b.item->parent);
    });
    for (std::size_t begin = 0, end = 1; begin < places.size(); begin = end++) {
        while (end < places.size() && places[end].item->parent == places[begin].item->parent
               && places[end].row == places[end - 1].row + 1)
            ++end;
        Q_EMIT dataChanged(indexOf(places[begin].item, Value), indexOf(places[end - 1].item, Age),
                           {Qt::DisplayRole, Qt::ForegroundRole, QualityRole});
    }
}

// ---- the model ----

SignalTreeModel::Item *SignalTreeModel::itemOf(const QModelIndex &index) const
{
    return index.isValid() ? static_cast<Item *>(index.internalPointer()) : m_root.get();
}

SignalTreeModel::Item *SignalTreeModel::itemOf(const Plant *plant) const
{
    const auto found = std::find_if(m_root->children.begin(), m_root->children.end(),
                                    [&](const ItemPtr &item) { return item->plant == plant; });
    return found == m_root->children.end() ? nullptr : found->get();
}

QModelIndex SignalTreeModel::indexOf(const Item *item, int column) const
{
    return item == m_root.get() ? QModelIndex() : createIndex(item->row(), column, const_cast<Item *>(item));
}

QModelIndex SignalTreeModel::index(int row, int column, const QModelIndex &parent) const
{
    if (!hasIndex(row, column, parent))
        return {};
    return createIndex(row, column, itemOf(parent)->children[std::size_t(row)].get());
}

QModelIndex SignalTreeModel::parent(const QModelIndex &child) const
{
    return child.isValid() ? indexOf(itemOf(child)->parent) : QModelIndex();
}

int SignalTreeModel::rowCount(const QModelIndex &parent) const
{
    return parent.column() > 0 ? 0 : int(itemOf(parent)->children.size());
}

int SignalTreeModel::columnCount(const QModelIndex &) const
{
    return ColumnCount;
}

QVariant SignalTreeModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    static const char *const titles[ColumnCount]
        = {QT_TR_NOOP("Name"), QT_TR_NOOP("Value"), QT_TR_NOOP("Unit"), QT_TR_NOOP("Age"), QT_TR_NOOP("Description")};
    if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
        return {};
    if (role == Qt::TextAlignmentRole)
        return int(Qt::AlignVCenter | (section == Value ? Qt::AlignRight : Qt::AlignLeft));
    if (role != Qt::DisplayRole)
        return {};
    return tr(titles[section]);
}

QString SignalTreeModel::signalText(const Item *item, int column) const
{
    const QPlcSignalDefinition &definition = definitionOf(item);
    switch (column) {
    case Name:
        return item->kind == Item::Element ? QStringLiteral("[%1]").arg(item->element) : definition.name;
    case Unit:
        return item->prefix.tableUnit() == definition.unit ? item->prefix.unit() : SiPrefix::unitText(definition.unit);
    case Value:
        return item->value;
    case Age:
        return item->quality == Plant::Good ? QString() : item->age;
    case Description:
        return item->kind == Item::Element ? QString() : definition.description;
    default:
        return {};
    }
}

QVariant SignalTreeModel::text(const Item *item, int column) const
{
    if (item->kind == Item::PlantItem)
        return column == Name ? item->plant->name() : column == Value ? stateWord(*item->plant) : QString();
    if (item->kind == Item::Writer)
        return column != Name         ? QString()
            : !item->writer.isEmpty() ? item->writer
            : item->plant->feed()     ? tr("Signals")  // who writes them is not told
                                      : tr("Not written");
    return signalText(item, column);
}

QVariant SignalTreeModel::toolTip(const Item *item) const
{
    if (item->kind < Item::Signal)
        return {};
    const QPlcSignalDefinition &definition = definitionOf(item);
    QStringList lines{QStringLiteral("%1: %2").arg(definition.name, definition.type.name())};
    if (!definition.rangeText().isEmpty())
        lines << definition.rangeText() + QLatin1Char(' ') + definition.unit;
    if (!definition.description.isEmpty())
        lines << definition.description;
    if (!definition.valueNames.isEmpty())
        lines << definition.valueNames.toText();
    const QString value = valueText(shownValue(item), definition);
    if (!value.isEmpty())
        lines << value + QLatin1Char(' ') + definition.unit;
    const QString writer = item->plant->writer(item->signal);
    lines << (writer.isEmpty() ? tr("written by no node") : tr("written by %1").arg(writer));
    lines << qualityText(item->plant->quality());
    return lines.join(QLatin1Char('\n'));
}

QVariant SignalTreeModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    Item *item = itemOf(index);
    const bool isSignal = item->kind >= Item::Signal;
    switch (role) {
    case Qt::DisplayRole:
        if (isSignal && (index.column() == Value || index.column() == Age)) {
            if (!m_lookedAt.contains(item)) {
                renew(item);
                m_lookedAt.insert(item);
            }
        }
        return text(item, index.column());
    case Qt::ForegroundRole:
        return isSignal ? foregroundOf(item->plant->quality() == Plant::Good || item->plant->quality() == Plant::AtRest)
                        : foregroundOf(item->plant->isConnected());
    case Qt::TextAlignmentRole:
        return isSignal && index.column() == Value ? QVariant(int(Qt::AlignRight | Qt::AlignVCenter)) : QVariant();
    case Qt::ToolTipRole:
        return toolTip(item);
    case ReferenceRole:
        return isSignal ? m_plants->reference(item->plant, item->signal, item->element).toString() : QString();
    case QualityRole:
        return item->plant->quality();
    case SearchRole: {
        if (!isSignal)
            return {};
        const QPlcSignalDefinition &definition = definitionOf(item);
        return QStringList{definition.name, definition.unit, definition.description, item->plant->writer(item->signal),
                           item->plant->name()}
            .join(QLatin1Char('\n'));
    }
    default:
        return {};
    }
}

Qt::ItemFlags SignalTreeModel::flags(const QModelIndex &index) const
{
    return index.isValid() ? Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled : Qt::NoItemFlags;
}

QVector<SignalReference> SignalTreeModel::references(const QModelIndex &index) const
{
    if (!index.isValid())
        return {};
    const Item *item = itemOf(index);
    if (item->kind >= Item::Signal)
        return {m_plants->reference(item->plant, item->signal, item->element)};
    QVector<SignalReference> all;
    for (int row = 0; row < int(item->children.size()); ++row)
        all += references(this->index(row, 0, index.sibling(index.row(), 0)));
    return all;
}

QModelIndex SignalTreeModel::find(const SignalReference &reference) const
{
    const PlantList::Signal wanted = m_plants->resolve(reference);
    const Item *plantItem = wanted ? itemOf(wanted.plant) : nullptr;
    if (!plantItem)
        return {};
    for (const ItemPtr &group : plantItem->children) {
        for (const ItemPtr &signal : group->children) {
            if (signal->signal != wanted.index)
                continue;
            const bool isElement = wanted.element != SignalReference::Whole && !signal->children.empty();
            return indexOf(isElement ? signal->children[std::size_t(wanted.element)].get() : signal.get());
        }
    }
    return {};
}

QStringList SignalTreeModel::mimeTypes() const
{
    return {signalsMimeType()};
}

QMimeData *SignalTreeModel::mimeData(const QModelIndexList &indexes) const
{
    QVector<SignalReference> all;
    for (const QModelIndex &index : indexes) {
        if (index.column() != 0 && indexes.contains(index.sibling(index.row(), 0)))
            continue;  // the same row again
        const QVector<SignalReference> of = references(index);
        std::copy_if(of.begin(), of.end(), std::back_inserter(all),
                     [&](const SignalReference &reference) { return !all.contains(reference); });
    }
    return all.isEmpty() ? nullptr : mimeDataOf(all).release();
}

}  // namespace qplc
