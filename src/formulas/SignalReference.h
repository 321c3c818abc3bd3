// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QMetaType>
#include <QtCore/QString>

namespace qplc {

/// A signal, or one element of it, as layouts and people write it: `signal`, `signal[2]`,
/// `plant/signal`, `plant/signal[2]`. A value type.
///
/// It names something that need not be there: PlantList::resolve() finds it.
struct SignalReference
{
    static constexpr int Whole = -1;  // all elements

    QString plant;  // empty: the one to which a panel is pinned, or the selected one of the window
    QString signal;
    int element = Whole;

    /// \return an invalid reference, with the reason in \a error, when \a text is none
    static SignalReference fromString(const QString &text, QString *error = nullptr);
    QString toString() const;
    bool isValid() const { return !signal.isEmpty(); }

    friend bool operator==(const SignalReference &a, const SignalReference &b)
    {
        return a.plant == b.plant && a.signal == b.signal && a.element == b.element;
    }
    friend bool operator!=(const SignalReference &a, const SignalReference &b) { return !(a == b); }
};

}  // namespace qplc

Q_DECLARE_METATYPE(qplc::SignalReference)
