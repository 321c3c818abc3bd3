// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QHash>
#include <QtCore/QObject>
#include <QtCore/QStringList>

#include <memory>

class QPlcPanelContext;

/// Control of some signals by a panel: who writes them, how the panel gets control, and the values that it sets.
///
/// ```cpp
/// class Throttle : public QPlcWidget
/// {
///     QPlcSignalControl m_control{context()};  // setSignals({"engine.speed"})
///     void mouseMoveEvent(QMouseEvent *event) override { m_control.set("engine.speed", speedAt(event->pos())); }
/// };
/// ```
/// The rules of the window hold. A signal that no node writes can be set as it is. A signal that a node writes
/// has to be taken first: the master grants a lease, which every window shows. Taking keeps the values that
/// are there, so nothing jumps. A signal that another person holds is taken only with AlsoFromOthers: ask
/// before. The lease ends with giveBack(), with this object, and when the window is lost: then the signal goes
/// to its neutral value. Nothing is set again by itself when the plant comes back.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcSignalControl : public QObject
{
    Q_OBJECT
public:
    /// Of several signals the last one of this list counts.
    enum State {
        Mine,        ///< this window holds them
        Free,        ///< no node writes them: set() sets them
        Written,     ///< a node writes them: take() first
        Lost,        ///< their holder is gone; neutral until a person takes them or gives them back
        Other,       ///< another person holds them
        Unwritable,  ///< the master itself measures them
        Offline,     ///< their plant is not connected
        Missing      ///< there is no such signal, or setSignals() was not called
    };
    Q_ENUM(State)
    enum TakeOver { OnlyFree, AlsoFromOthers };
    Q_ENUM(TakeOver)

    /// \param context  of the panel, which outlives this object
    explicit QPlcSignalControl(QPlcPanelContext *context, QObject *parent = nullptr);
    /// Gives back what it holds.
    ~QPlcSignalControl() override;

    /// Sets the signals, as references (QPlcPanelContext). Gives back what it held.
    void setSignals(const QStringList &references);
    QStringList signalNames() const;

    State state() const;
    /// Returns whether set() has an effect.
    bool mayWrite() const;
    bool mayTake() const;
    bool mayGiveBack() const;
    /// Returns the nodes that write the signals, or the people who hold them: "Autopilot", "anna@lab".
    QString who() const;
    /// Returns a sentence on who has control, or on what is missing.
    QString text() const;
    /// Returns the value to which a signal goes when it has no writer; NaN when it is no number.
    double neutral(const QString &reference) const;

    /// Takes all of the signals. \param takeOver  others lose them only with AlsoFromOthers
    void take(TakeOver takeOver = OnlyFree);
    void giveBack();
    /// Sets one of the signals, as near to \a value as the limits of the table allow. Call it as often as you
    /// like: values that come faster than the master takes them are left out, the last one never is.
    /// \return false: nothing was set, because mayWrite() is false or \a reference is no number of setSignals()
    bool set(const QString &reference, double value);

Q_SIGNALS:
    /// State, who, text, or what may be done.
    void changed();
    /// The signals are those of another plant in a moment: end what a person does in this one.
    void leaving();
    /// The master has refused something. \param sentence  why, and what to do
    void failed(const QString &sentence);

private:
    struct Private;
    std::unique_ptr<Private> d;
};
