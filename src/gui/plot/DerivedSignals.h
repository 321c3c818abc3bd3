// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DerivedSignal.h"
#include "gui/plant/PlantList.h"

#include <QtCore/QHash>
#include <QtCore/QTimer>

#include <memory>

namespace qplc {

/// The derived signals of a window that somebody looks at, each once: made when they are wanted,
/// filled with the past in slices that do not hold the window up, then with each new row.
///
/// A derived signal lives as long as somebody holds it. Threads: that of the window.
class DerivedSignals : public QObject
{
    Q_OBJECT
public:
    /// A slice of the past: some ms.
    static constexpr SignalStore::Row sliceRows = 20'000;

    explicit DerivedSignals(PlantList *plants, QObject *parent = nullptr);

    struct Result
    {
        std::shared_ptr<DerivedSignal> derived;  // null: error says why
        Plant *plant = nullptr;
        QString unit;
        QString error;
    };
    /// Finds or makes what \a text, a formula, means at the moment. \param pin the plant that
    /// signals without a plant are of; empty: the selected one
    Result find(const QString &text, const QString &pin = QString());
    /// Stores or tables of plants are others: what is found next is made anew. What is held stays
    /// as it is.
    void forget(const Plant *plant);
    void forgetStale();
    /// How many are alive.
    int count() const;

public Q_SLOTS:
    /// Takes the new rows of a plant.
    void update(qplc::Plant *plant);

Q_SIGNALS:
    /// More of the past has been calculated: worth drawing, also where time stands still.
    void filled();

private:
    struct Entry
    {
        std::weak_ptr<DerivedSignal> derived;
        Plant *plant;
        const SignalStore *source;
        quint64 tableHash;
        bool isFilled;
    };
    struct Operands
    {
        Plant *plant = nullptr;
        std::vector<std::vector<int>> channels;
        QStringList units;
        QString error;
    };

    bool isTrue(const Entry &entry) const;
    Operands resolve(const Formula &formula, const QString &pin) const;
    QString resolveOperand(const Formula &formula, const Formula::Operand &operand, const QString &pin,
                           Operands *found) const;
    void fillSlice();

    PlantList *m_plants;
    QHash<QPair<Plant *, QString>, Entry> m_entries;  // by plant and text
    QTimer m_filler;
};

}  // namespace qplc
