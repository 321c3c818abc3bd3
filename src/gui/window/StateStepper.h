// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantSummary.h"
#include "gui/panel/WindowContext.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// The way of a master: Off -> Initialized -> Real time, and where it is.
class StateStepper : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the widget
    explicit StateStepper(WindowContext *context, QWidget *parent = nullptr);

    void show(const StateStep &step);
    StateStep::Step step() const { return m_step.step; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    QString textOf(StateStep::Step step) const;

    WindowContext *m_context;
    StateStep m_step;
};

}  // namespace qplc
