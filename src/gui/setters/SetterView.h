// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterTarget.h"

#include <QtCore/QJsonObject>
#include <QtWidgets/QWidget>

namespace qplc {

/// The part of a setter that is moved by hand: one class for each style.
class SetterView : public QWidget
{
    Q_OBJECT
public:
    SetterView(SetterTarget *target, QWidget *parent);

    /// A new view of the style that a layout names; a number for names that it does not know.
    static SetterView *create(const QString &style, SetterTarget *target, QWidget *parent);
    /// All styles: "number", "slider", ...
    static QStringList styles();

    /// Signal, limits or control are other ones.
    virtual void refresh() = 0;
    /// There may be a new actual value; at most 10 times a second.
    virtual void showActual() {}
    /// The actual value for people. \pre there is a signal
    virtual QString actualText() const;
    virtual void applySettings(const QJsonObject & /*settings*/) {}

Q_SIGNALS:
    /// Something that a person should know about what was done last; empty: all is well.
    void said(const QString &sentence);
    /// Settings of the generator were edited here: their JSON, without what is default.
    void generatorEdited(const QJsonObject &generator);

protected:
    SetterTarget &target() { return *m_target; }
    const SetterTarget &target() const { return *m_target; }

private:
    SetterTarget *m_target;
};

// The view of each style, in a file of its own.
SetterView *createNumberView(SetterTarget *target, QWidget *parent);
SetterView *createSliderView(SetterTarget *target, QWidget *parent);
SetterView *createToggleView(SetterTarget *target, QWidget *parent);
SetterView *createMomentaryView(SetterTarget *target, QWidget *parent);
SetterView *createGeneratorView(SetterTarget *target, QWidget *parent);
SetterView *createKnobView(SetterTarget *target, QWidget *parent);
SetterView *createChoiceView(SetterTarget *target, QWidget *parent);

}  // namespace qplc
