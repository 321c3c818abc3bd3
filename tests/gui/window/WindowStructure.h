// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QRegularExpression>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QLabel>
#include <QtWidgets/QWidget>

/// A window as it can be compared from one version to the next: not its pixels, but what is seen
/// where.
class WindowStructure
{
public:
    explicit WindowStructure(QWidget *window)
        : m_window(window)
    {
    }

    /// Texts of visible buttons and labels, from above to below and from left to right.
    QStringList texts() const
    {
        QMap<QPair<int, int>, QString> found;
        for (QWidget *widget : m_window->findChildren<QWidget *>()) {
            const QString text = textOf(widget);
            if (!text.isEmpty() && widget->isVisible())
                found.insert({placeOf(widget).y(), placeOf(widget).x()}, text);
        }
        return found.values();
    }

    bool shows(const QString &pattern) const { return !texts().filter(QRegularExpression(pattern)).isEmpty(); }

    /// Visible buttons of this kind that are not within the window, or are smaller than their text
    /// needs: nothing is expected.
    template<typename Button>
    QStringList cutButtons() const
    {
        QStringList cut;
        for (QAbstractButton *button : m_window->findChildren<Button *>()) {
            if (!button->isVisible() || button->window() != m_window)
                continue;
            const QRect place(placeOf(button), button->size());
            const QSize least = button->minimumSizeHint();
            if (!m_window->rect().contains(place) || button->width() < least.width()
                || button->height() < least.height())
                cut.append(button->text() + button->objectName());
        }
        return cut;
    }

private:
    static QString textOf(const QWidget *widget)
    {
        if (const auto *button = qobject_cast<const QAbstractButton *>(widget))
            return button->text();
        const auto *label = qobject_cast<const QLabel *>(widget);
        return label ? label->text() : QString();
    }
    QPoint placeOf(const QWidget *widget) const { return widget->mapTo(m_window, QPoint(0, 0)); }

    QWidget *m_window;
};
