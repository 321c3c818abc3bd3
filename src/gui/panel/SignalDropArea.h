// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QRect>
#include <QtCore/QStringList>

#include <functional>

namespace qplc {

/// A part of a panel in which dropped signals mean something else than in the rest of it: the right
/// axis of a plot. A child of the widget of the panel.
class SignalDropArea : public QObject
{
    Q_OBJECT
public:
    /// \param area [px of the widget]; null: there is none now \param add takes signals; false: it
    ///         has no use for any
    SignalDropArea(const QString &text, std::function<QRect()> area, std::function<bool(const QStringList &)> add,
                   QObject *widget)
        : QObject(widget)
        , m_text(text)
        , m_area(std::move(area))
        , m_add(std::move(add))
    {
    }

    /// What people read there.
    QString text() const { return m_text; }
    QRect area() const { return m_area(); }
    bool add(const QStringList &references) const { return m_add(references); }

private:
    QString m_text;
    std::function<QRect()> m_area;
    std::function<bool(const QStringList &)> m_add;
};

}  // namespace qplc
