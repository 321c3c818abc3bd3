// SPDX-License-Identifier: Apache-2.0
#include "PlantList.h"

#include "PlantRecording.h"

#include <QtCore/QFileInfo>

#include <algorithm>

namespace qplc {

namespace {

/// All recordings together take as much memory as one may.
void shareMemory(const std::vector<std::unique_ptr<Plant>> &plants)
{
    std::vector<PlantRecording *> recordings;
    for (const std::unique_ptr<Plant> &plant : plants) {
        if (plant->recording())
            recordings.push_back(plant->recording());
    }
    for (PlantRecording *recording : recordings) {
        const std::int64_t share = PlantRecording::UsualMemory / std::int64_t(recordings.size());
        if (recording->memory() != share)
            recording->setMemory(share);
    }
}

}  // namespace

QPlcValue PlantList::Signal::value() const
{
    const QPlcValue whole = plant ? plant->value(index) : QPlcValue();
    if (element == SignalReference::Whole || !whole.isValid())
        return whole;
    const int size = whole.type().elementSize();
    return QPlcValue::fromBytes(QPlcSignalType(whole.type().scalar()), whole.toBytes().constData() + element * size);
}

int PlantList::Signal::channel() const
{
    if (!plant || (element == SignalReference::Whole && definition().type.isArray()))
        return ChannelMap::NoChannel;
    return plant->values().channels().channel(index, std::max(element, 0));
}

PlantList::PlantList(QObject *parent)
    : QObject(parent)
{
}

PlantList::~PlantList()
{
    while (size() > 0)  // whoever outlives this list lets go of them
        remove(at(size() - 1));
}

QString PlantList::freeName(const QString &wanted) const
{
    QString name = wanted;
    for (int number = 2; find(name); ++number)
        name = QStringLiteral("%1 (%2)").arg(wanted).arg(number);
    return name;
}

/// The smallest that no plant has.
int PlantList::freeNumber() const
{
    const auto isTaken = [this](int number) {
        return std::any_of(m_plants.begin(), m_plants.end(),
                           [number](const std::unique_ptr<Plant> &plant) { return plant->number() == number; });
    };
    int number = 0;
    while (isTaken(number))
        ++number;
    return number;
}

Plant *PlantList::insert(const QString &address, const QString &name, const QString &nodeName)
{
    const int number = freeNumber();
    m_plants.push_back(std::make_unique<Plant>(
        address, freeName(name.isEmpty() ? PlantAddress::withoutSecurity(address) : name), nodeName));
    Plant *plant = m_plants.back().get();
    plant->setNumber(number);
    plant->setRate(m_rate);
    if (!m_selected)
        m_selected = plant;
    connect(plant, &Plant::tableChanged, this, &PlantList::signalsChanged);
    connect(plant, &Plant::eventOccurred, this, &PlantList::eventOccurred);
    return plant;
}

Plant *PlantList::add(const QString &address, const QString &name, const QString &nodeName)
{
    Plant *plant = insert(address, name, nodeName);
    Q_EMIT added(plant);
    plant->open();
    return plant;
}

Plant *PlantList::addFed(const QString &name)
{
    Plant *plant = insert(QString(), name, QString());
    plant->makeFeed();
    Q_EMIT added(plant);
    return plant;
}

Plant *PlantList::addRecording(const QStringList &paths, const QString &name, QString *error)
{
    auto recording = std::make_unique<Recording>();
    if (!recording->open(paths, error))
        return nullptr;
    const QString usual = QFileInfo(recording->files().front().name).completeBaseName();
    Plant *plant = insert(QString(), name.isEmpty() ? usual : name, QString());
    plant->makeRecording(std::move(recording));
    shareMemory(m_plants);
    Q_EMIT added(plant);
    return plant;
}

void PlantList::remove(Plant *plant)
{
    const int place = indexOf(plant);
    if (place < 0)
        return;
    const bool wasSelected = plant == m_selected;
    if (wasSelected)
        Q_EMIT aboutToSelect();
    const std::unique_ptr<Plant> last = std::move(m_plants[std::size_t(place)]);
    m_plants.erase(m_plants.begin() + place);
    if (wasSelected)
        m_selected = m_plants.empty() ? nullptr : m_plants.front().get();
    if (plant->recording())
        shareMemory(m_plants);
    Q_EMIT removed(plant);
    Q_EMIT signalsChanged();
    if (wasSelected)
        Q_EMIT selectionChanged();
}

void PlantList::select(Plant *plant)
{
    if (plant == m_selected || indexOf(plant) < 0)
        return;
    Q_EMIT aboutToSelect();
    m_selected = plant;
    Q_EMIT signalsChanged();
    Q_EMIT selectionChanged();
}

void PlantList::setRate(double timesPerSecond)
{
    m_rate = timesPerSecond;
    for (const std::unique_ptr<Plant> &plant : m_plants)
        plant->setRate(timesPerSecond);
}

int PlantList::indexOf(const Plant *plant) const
{
    const auto found = std::find_if(m_plants.begin(), m_plants.end(),
                                    [&](const std::unique_ptr<Plant> &other) { return other.get() == plant; });
    return found == m_plants.end() ? -1 : int(found - m_plants.begin());
}

Plant *PlantList::find(const QString &name) const
{
    const auto found = std::find_if(m_plants.begin(), m_plants.end(),
                                    [&](const std::unique_ptr<Plant> &plant) { return plant->name() == name; });
    return found == m_plants.end() ? nullptr : found->get();
}

QVector<Plant *> PlantList::all() const
{
    QVector<Plant *> all;
    for (const std::unique_ptr<Plant> &plant : m_plants)
        all << plant.get();
    return all;
}

QStringList PlantList::names() const
{
    QStringList names;
    for (const std::unique_ptr<Plant> &plant : m_plants)
        names << plant->name();
    return names;
}

PlantList::Signal PlantList::find(Plant *plant, const SignalReference &reference)
{
    const QPlcSignalIndex index = plant->table().indexOf(reference.signal);
    if (index == QPlcInvalidSignalIndex)
        return {};
    const QPlcSignalType type = plant->table().at(index).type;
    const bool isThere = reference.element == SignalReference::Whole
        || (type.isNumeric() && reference.element >= 0 && reference.element < type.count());
    return isThere ? Signal{plant, index, reference.element} : Signal();
}

Plant *PlantList::plantOf(const SignalReference &reference, const QString &pin) const
{
    const QString &name = reference.plant.isEmpty() ? pin : reference.plant;
    return name.isEmpty() ? m_selected : find(name);
}

PlantList::Signal PlantList::resolve(const SignalReference &reference, const QString &pin) const
{
    Plant *plant = plantOf(reference, pin);
    return plant ? find(plant, reference) : Signal();
}

SignalReference PlantList::reference(const Plant *plant, QPlcSignalIndex signal, int element) const
{
    return {size() > 1 ? plant->name() : QString(), plant->table().at(signal).name, element};
}

}  // namespace qplc
