// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantSelection.h"
#include "ViolationWatch.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QHash>
#include <QtWidgets/QAbstractButton>

namespace qplc {

/// Shows the selected plant: dot, name and condition, and its figures below; a click lists all
/// plants and what is done with them.
class PlantSelector : public QAbstractButton
{
    Q_OBJECT
public:
    /// \param selection, context  outlive the widget
    PlantSelector(PlantSelection *selection, WindowContext *context, QWidget *parent = nullptr);

    /// What stands in the list below the plants.
    void setMenuActions(const QList<QAction *> &actions) { m_actions = actions; }
    QString headline() const { return m_headline; }
    QString figures() const { return m_figures; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();
    void watchViolations();
    void openMenu();
    void drawFigures(QPainter *painter, const QRect &place);

    PlantSelection *m_selection;
    WindowContext *m_context;
    QList<QAction *> m_actions;
    QString m_name;
    QString m_headline;
    QString m_figures;
    QString m_violations;
    QString m_profile;
    QHash<const Plant *, ViolationWatch> m_watches;
    QElapsedTimer m_clock;
    QColor m_color;
    QColor m_plantColor;  // invalid while there is only one plant
};

}  // namespace qplc
