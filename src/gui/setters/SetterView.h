// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterTarget.h"

#include <QtCore/QJsonObject>
#include <QtWidgets/QWidget>

#include <memory>

namespace qplc {

struct Theme;

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
    /// Settings of this style beyond signal, style and limits; the defaults are left out.
    virtual QJsonObject settings() const { return {}; }
    virtual void applySettings(const QJsonObject & /*settings*/) {}

Q_SIGNALS:
    /// Something that a person should know about what was done last; empty: all is well.
    void said(const QString &sentence);
    void settingsEdited();

protected:
    SetterTarget &target() { return *m_target; }
    const SetterTarget &target() const { return *m_target; }

private:
    SetterTarget *m_target;
};

}  // namespace qplc
