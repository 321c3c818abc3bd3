// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LayoutTarget.h"

#include <QtCore/QObject>
#include <QtCore/QPointer>

class QWidget;

namespace qplc {

class DropOverlay;
class LayoutView;
class PanelFrame;

/// A panel that is dragged by its title bar: shows where it would go, and moves it there in the
/// end. It needs no event loop of its own.
class PanelDrag : public QObject
{
    Q_OBJECT
public:
    explicit PanelDrag(LayoutView *view);
    ~PanelDrag() override;

    void move(const QString &panelId, const QPoint &globalPosition);
    void finish(const QString &panelId, const QPoint &globalPosition);
    void cancel();

private:
    /// Where a panel would go, and the part of a widget that says so; no widget: into a window of
    /// its own.
    struct Place
    {
        QWidget *widget = nullptr;
        QRect rect;
        std::optional<LayoutTarget> target;  // none: it stays
    };

    Place placeAt(const QString &panelId, const QPoint &globalPosition) const;
    Place placeIn(QWidget *window, const QString &panelId, const QPoint &globalPosition) const;
    Place placeInTabs(const QString &panelId, const QPoint &globalPosition) const;
    void putIntoWindow(const QString &panelId, const QPoint &globalPosition);

    LayoutView *m_view;
    QPointer<DropOverlay> m_overlay;
};

}  // namespace qplc
