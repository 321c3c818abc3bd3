// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Plant.h"
#include "formulas/SignalReference.h"

#include <memory>
#include <vector>

namespace qplc {

/// All plants of a window, one of which is selected: its bar and all names without a plant mean
/// that one. None of them waits for another one.
class PlantList : public QObject
{
    Q_OBJECT
public:
    /// What a reference means at the moment.
    struct Signal
    {
        Plant *plant = nullptr;  // null: nothing
        QPlcSignalIndex index = QPlcInvalidSignalIndex;
        int element = SignalReference::Whole;

        explicit operator bool() const { return plant != nullptr; }
        const QPlcSignalDefinition &definition() const { return plant->table().at(index); }
        /// The value of the signal, or of its element; invalid before the first.
        QPlcValue value() const;
        /// What the master says of it; Plant::quality() says whether that is of now.
        QPlcQuality quality() const { return plant->values().quality(index); }
        /// The channel in the store of the plant: of the element, or of the only one;
        /// ChannelMap::NoChannel for texts, times and whole arrays.
        int channel() const;
    };

    explicit PlantList(QObject *parent = nullptr);
    ~PlantList() override;

    /// Adds a plant and connects it for ever. \param name made unique with a number when it is
    /// taken
    Plant *add(const QString &address, const QString &name = QString(), const QString &nodeName = QString());
    /// Adds a plant that a program feeds (Plant::feed()).
    Plant *addFed(const QString &name);
    /// Adds a recording (Plant::recording()). \param name  empty: that of the first file or folder
    /// \return null, with \a error, when it cannot be read
    Plant *addRecording(const QStringList &paths, const QString &name, QString *error);
    void remove(Plant *plant);
    /// Calls \a follow with each plant: with those that are there now, and with those that come, as
    /// long as \a receiver lives.
    template<typename Receiver>
    void forEach(Receiver *receiver, void (Receiver::*follow)(Plant *))
    {
        connect(this, &PlantList::added, receiver, follow);
        for (const std::unique_ptr<Plant> &plant : m_plants)
            (receiver->*follow)(plant.get());
    }
    /// Of all plants, also those that come: Plant::setRate().
    void setRate(double timesPerSecond);
    int size() const { return int(m_plants.size()); }
    QVector<Plant *> all() const;
    Plant *at(int place) const { return m_plants[std::size_t(place)].get(); }
    /// -1 when it is none of them.
    int indexOf(const Plant *plant) const;
    /// Null when there is none.
    Plant *find(const QString &name) const;
    QStringList names() const;

    /// Null while there is no plant. The first one is selected by itself; the one that follows a
    /// selected plant that is removed is the first that is left.
    Plant *selected() const { return m_selected; }
    /// Does nothing for a plant of another list.
    void select(Plant *plant);

    /// The plant of \a reference; for a reference without one \a pin, or the selected plant. Null
    /// when there is none of this name.
    Plant *plantOf(const SignalReference &reference, const QString &pin = QString()) const;
    /// False when its plant has no such signal or element now. \param pin  as in plantOf()
    Signal resolve(const SignalReference &reference, const QString &pin = QString()) const;
    /// How to write a signal: with its plant only when there are several.
    SignalReference reference(const Plant *plant, QPlcSignalIndex signal, int element = SignalReference::Whole) const;

Q_SIGNALS:
    void added(qplc::Plant *plant);
    /// The plant is no more in the list, and ends after this.
    void removed(qplc::Plant *plant);
    /// References without a plant mean another plant in a moment: the last time to end what was
    /// begun in the present one.
    void aboutToSelect();
    /// Another plant is selected, after signalsChanged(), or none is left.
    void selectionChanged();
    /// References may mean something else from here on.
    void signalsChanged();
    void eventOccurred(const qplc::PlantEvent &event);

private:
    Plant *insert(const QString &address, const QString &name, const QString &nodeName);
    QString freeName(const QString &wanted) const;
    int freeNumber() const;
    static Signal find(Plant *plant, const SignalReference &reference);

    std::vector<std::unique_ptr<Plant>> m_plants;
    Plant *m_selected = nullptr;
    double m_rate = 0.0;
};

}  // namespace qplc
