// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcValue.h"

#include <QtCore/QHash>
#include <QtCore/QObject>
#include <QtCore/QStringList>

#include <memory>

class QPlcPanelContext;

/// Control of some signals by a panel: who writes them, how the panel gets control, and the values
/// that it sets.
///
/// \code
/// class Throttle : public QPlcWidget
/// {
/// public:
///     explicit Throttle(QWidget *parent = nullptr) : QPlcWidget(parent)
///     {
///         m_control.setSignals({"engine.speed"});
///     }
///
/// protected:
///     void mouseMoveEvent(QMouseEvent *event) override
///     {
///         m_control.set("engine.speed", event->x() / 10.0);
///     }
///
/// private:
///     QPlcSignalControl m_control{context()};
/// };
/// \endcode
///
/// A signal that no node writes can be set at any time. For a signal that a node writes call take()
/// first: the master grants a lease, which every window shows. take() keeps the present values, so
/// nothing jumps. A signal that another person holds is taken only with AlsoFromOthers: ask that
/// person before. The lease ends with giveBack(), with this object, and when the window is lost;
/// the signal then goes to its neutral value. Nothing is set again by itself when the plant comes
/// back.
///
/// Choose the function by the input device:
/// - a slider or a joystick: set(). It sends the newest value as often as the master takes one.
/// - a button, a list or a text field: send(). Each value reaches the master.
/// - a push button that acts while a person presses it: hold() and endHold(). The signal goes to
///   its neutral value also if the window or its connection is lost.
///
/// failed() tells why the master has refused something. The setters and the keyboard control of
/// QtPLC use this class and no other one.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcSignalControl : public QObject
{
    Q_OBJECT
public:
    /// Who controls the signals. If they differ, the last state of this list counts.
    enum State {
        Mine,     ///< this window holds them
        Free,     ///< no node writes them: set() sets them
        Written,  ///< a node writes them: call take() first
        /// Their holder is gone: they are neutral until a person takes or releases them.
        Lost,
        Other,       ///< another person holds them
        Unwritable,  ///< the master itself writes them
        Offline,     ///< their plant is not connected
        Missing      ///< there is no such signal, or setSignals() was not called
    };
    Q_ENUM(State)
    /// From whom take() takes signals.
    enum TakeOver {
        OnlyFree,       ///< only signals that no other person holds
        AlsoFromOthers  ///< also signals that other persons hold: they lose control
    };
    Q_ENUM(TakeOver)
    /// Values with which control begins.
    enum Beginning {
        Present,  ///< the present values: nothing jumps
        Neutral   ///< the neutral values
    };
    Q_ENUM(Beginning)

    /// Makes an object that controls no signals yet.
    /// \param context  of the panel; outlives this object
    /// \param parent  owns this object, if given
    explicit QPlcSignalControl(QPlcPanelContext *context, QObject *parent = nullptr);
    /// Sends the last value, and releases what this object holds.
    ~QPlcSignalControl() override;

    /// Sets the signals, as references (QPlcPanelContext). The former ones are released.
    void setSignals(const QStringList &references);
    /// Returns the references of setSignals().
    QStringList signalNames() const;
    /// Sets with which values take() begins. Default: Present.
    void setBeginning(Beginning beginning);
    /// Keeps leases when this object is destroyed or gets other signals. The window still shows
    /// them, and a person releases them there. Default: false.
    void setKeepsControl(bool keepsControl);

    /// Returns who controls the signals.
    State state() const;
    /// Returns true if set() has an effect.
    bool mayWrite() const;
    /// Returns false while you hold the signals, or if one is missing or cannot be leased.
    bool mayTake() const;
    /// Returns true if giveBack() is possible.
    bool mayGiveBack() const;
    /// Returns the nodes that write the signals, or the persons who hold them: "Autopilot",
    /// "anna@lab".
    QString who() const;
    /// Returns a sentence that says who has control, or what is missing.
    QString text() const;
    /// Returns the value that a signal gets when it has no writer; NaN if it is not a number or not
    /// one of setSignals().
    double neutral(const QString &reference) const;
    /// Returns the neutral values of all signals for people: "tetherSpeed 1 m/s", "all 0"; empty if
    /// there are no signals.
    QString neutralText() const;
    /// Returns the names of the plants of the signals, separated by commas; empty if the window has
    /// fewer than two plants.
    QString plantNames() const;

    /// Asks the master for leases of all signals. changed() or failed() follows.
    /// \param takeOver  with AlsoFromOthers other persons lose them
    void take(TakeOver takeOver = OnlyFree);
    /// Sends the last value, and releases all signals.
    void giveBack();
    /// Sets one of the signals. A value outside of the limits of the signal table becomes the
    /// limit; an integer signal gets the nearest integer. Call it as often as you like: values that
    /// come faster than the master takes them are skipped, but never the last one.
    /// \return false if nothing was set: mayWrite() is false, or \a reference is not a number of
    ///     setSignals()
    bool set(const QString &reference, double value);
    /// Sets several of the signals in the same cycle, as set() does: for example elements of one
    /// array, each by its reference.
    /// \return false if nothing was set, because this is not possible for one of them
    bool set(const QHash<QString, double> &values);
    /// Sends one value of any type: a text, an array, or a number, which is limited as by set(). A
    /// number for an array is the value of all its elements. Each value reaches the master, also if
    /// an earlier one is in progress.
    /// \return false if nothing was sent: mayWrite() is false, \a reference is not one of
    ///     setSignals(), or \a value does not fit its type
    bool send(const QString &reference, const QPlcValue &value);
    /// Sets those signals to their neutral values that this window holds, also if other persons
    /// hold other ones of setSignals().
    void setNeutral();

    /// Sets one of the signals until endHold(). While it is held, you can call this or set() again
    /// with other values. A signal that no node writes is leased meanwhile, so that it goes to its
    /// neutral value if the window is lost.
    /// \return false if nothing was set, for the reasons of set()
    bool hold(const QString &reference, double value);
    /// Sets all signals of hold() to their neutral values.
    void endHold();
    /// Returns true between hold() and endHold() or holdLost().
    bool isHolding() const;

Q_SIGNALS:
    /// Emitted when state(), who(), text(), or what is possible has changed, or when the signals
    /// have become other ones.
    void changed();
    /// Emitted before the signals become those of another plant: end what the person does in this
    /// one.
    void leaving();
    /// Emitted when hold() has ended without endHold(): another person has taken the signal, or the
    /// plant was lost or changed.
    void holdLost();
    /// Emitted when the master has refused something.
    /// \param sentence  why, and what to do
    void failed(const QString &sentence);

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
