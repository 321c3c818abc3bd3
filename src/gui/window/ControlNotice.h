// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "ControlSummary.h"

namespace qplc {

/// Says in the bar above everything what this window controls by hand, what others do, and what is
/// lost; with a button that gives it back. Its place is kept while there is nothing to say, so that
/// nothing moves below the mouse of somebody who takes control.
class ControlNotice : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the notice
    explicit ControlNotice(WindowContext *context, QWidget *parent = nullptr);

    const QVector<ControlFact> &facts() const { return m_facts; }
    /// Of the two lines; empty while there is nothing to say.
    QStringList lines() const;
    /// Whether this window holds something, or something is lost.
    bool isToGiveBack() const;
    BarButton *giveBackButton() const { return m_giveBack; }

    /// So that "You control" is read on small screens: bars take the same from all of their parts.
    QSize sizeHint() const override { return {460, 44}; }
    QSize minimumSizeHint() const override { return {120, 44}; }
    /// The place of lines().
    QRect textRect() const;

Q_SIGNALS:
    void factsChanged();

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();
    QColor colorOf(const ControlFact &fact) const;

    WindowContext *m_context;
    BarButton *m_giveBack;
    QVector<ControlFact> m_facts;
};

}  // namespace qplc
