// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/LayoutView.h"

namespace qplc {

/// What becomes of signals that a person drops on panels, or chooses a panel for. All of it are
/// steps that can be undone.
class SignalPlacer : public QObject
{
    Q_OBJECT
public:
    /// \param view  outlives this object
    explicit SignalPlacer(LayoutView *view);

    /// In the middle of a panel they are shown there, if it has a use for them; else in a plot of
    /// their own at the side. \param panelId empty: an empty tab
    void drop(const QString &panelId, DropZone zone, const QStringList &references);
    /// Shows signals in the panel of this type that has the focus, or the first one of the tab, or
    /// a new one; a gauge always is a new one for each signal.
    void show(const QStringList &references, const QString &type);
    /// Shows the first panel of this type, wherever it is, or a new one.
    void showPanel(const QString &type);

    static QJsonObject settingsFor(const QString &type, const QStringList &references);

private:
    bool addTo(const QString &panelId, const QStringList &references, DropZone zone = DropZone::Center);
    QString panelOfType(const QString &type) const;

    LayoutView *m_view;
};

}  // namespace qplc
