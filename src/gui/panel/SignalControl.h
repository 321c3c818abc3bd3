// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <QtCore/QPointer>
#include <QtCore/QVector>

class QPlcPanelContext;

namespace qplc {

/// Who writes some signals, and how this window gets and gives back control of them: all at once,
/// by leases.
///
/// Looks up its signals again by itself when plants, tables, writers or leases change.
class SignalControl : public QObject
{
    Q_OBJECT
public:
    /// Of several signals the one with the greatest number counts: control is theirs as a whole.
    enum State {
        Mine,        // this window holds them
        Free,        // nobody writes them: they can be set as they are
        Written,     // by a node: to be taken over first
        Lost,        // a holder is gone; neutral until somebody takes them or gives them back
        Other,       // held by somebody else
        Unwritable,  // measured by the master itself
        Offline,     // the plant is not connected
        Missing      // there is no such signal, or none was chosen
    };
    Q_ENUM(State)

    using QObject::QObject;

    /// Knows the plants of a panel, and the one to which it is pinned.
    /// \param context outlives this
    void setContext(QPlcPanelContext *context);
    /// \param plants  null: none
    void setPlants(PlantList *plants);
    /// The plant that references without one mean; empty: the selected one of the window.
    void setPin(const QString &plant);
    void setSignals(const QVector<SignalReference> &references);
    bool hasPlants() const { return m_plants; }
    const QVector<SignalReference> &references() const { return m_references; }
    /// What the references mean now, in their order; false for what is missing.
    const QVector<PlantList::Signal> &resolved() const { return m_resolved; }

    /// Names of the plants of the signals, where the window has several; empty otherwise.
    QString plantNames() const;

    State state() const { return m_state; }
    /// Whether values of this window are taken.
    bool mayWrite() const { return m_state == Mine || m_state == Free; }
    bool mayTake() const;
    bool mayGiveBack() const { return m_state == Mine || m_state == Lost; }
    /// Nodes that write the signals, people who hold them: "Autopilot", "anna@lab"; empty: nobody.
    QString who() const { return m_who.join(QStringLiteral(", ")); }
    /// A sentence on who has control, or on what is missing.
    QString text() const;

    /// The values with which control begins.
    enum Beginning {
        Present,  // those that are taken over: nothing jumps
        Neutral
    };
    void setBeginning(Beginning beginning) { m_beginning = beginning; }
    /// The neutral values of the signals, for people: "tetherSpeed 1 m/s", "all 0"; empty where
    /// there are no signals
    QString neutralText() const;

    /// Takes all of the signals. From others only with \a takeOver.
    void take(Plant::TakeOver takeOver = Plant::OnlyFree);
    void giveBack();
    /// failed() is to tell when this command is refused.
    void follow(Plant *plant, int command) { m_commands.append({plant, command}); }

Q_SIGNALS:
    /// The signals are those of another plant in a moment: what was begun ends now, in the plant in
    /// which it was begun.
    void leaving();
    /// The signals are other ones, or stand for something else.
    void signalsChanged();
    /// state(), who(), text() or mayTake().
    void changed();
    /// A plant has new values.
    void updated();
    /// The master has refused a command of this object, or one that it follows.
    /// \param sentence why
    void failed(const QString &sentence);

private:
    void listenTo(Plant *plant);
    bool hasPlainReference() const;
    void resolve();
    void judge();
    bool assess();
    State stateOf(const PlantList::Signal &signal, QStringList *who) const;
    QString firstMissing() const;
    QHash<Plant *, QStringList> namesByPlant() const;

    QPointer<PlantList> m_plants;
    QString m_pin;
    QVector<SignalReference> m_references;
    QVector<PlantList::Signal> m_resolved;
    State m_state = Missing;
    Beginning m_beginning = Present;
    QStringList m_who;
    QString m_plantText;  // of one that is not connected
    bool m_couldTake = false;
    QVector<QPair<Plant *, int>> m_commands;
};

/// The value where \a signal goes when nobody steers it, as its type; of an element the element.
QPlcValue neutralValue(const PlantList::Signal &signal);
/// The whole value of \a signal in which the element that it stands for, or all, is \a number.
/// Invalid: it is no number, or the value of the others is not known yet.
QPlcValue wholeValue(const PlantList::Signal &signal, double number);
/// \param others  the value of the other elements
QPlcValue wholeValue(const PlantList::Signal &signal, double number, const QPlcValue &others);

}  // namespace qplc
