// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"
#include "node/session/MasterFinder.h"

#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QWidget>

namespace qplc {

class BarButton;

/// Masters that were found, each as a button that leads there. A button stays the same while its
/// master is there, so that keys and mouse do not lose it.
class FoundMasters : public QWidget
{
    Q_OBJECT
public:
    /// \param most  so many are shown; those of this computer come first
    /// \param context  outlives the list
    FoundMasters(QBoxLayout::Direction direction, int most, WindowContext *context, QWidget *parent = nullptr);

    /// \param before  the widget behind which keys come to the list
    /// \param refuge  gets the focus when the master that had it is gone
    void setMasters(const QVector<FoundMaster> &masters, QWidget *before, QWidget *refuge);

Q_SIGNALS:
    void masterChosen(const QString &address);

protected:
    void keyPressEvent(QKeyEvent *event) override;

private:
    BarButton *buttonOf(const QString &address) const;
    BarButton *makeButton(const QString &address);
    void removeAllBut(const QVector<FoundMaster> &masters);
    bool hasFocusWithin() const;
    void describe(BarButton *button, const FoundMaster &master) const;

    WindowContext *m_context;
    QBoxLayout *m_layout;
    const int m_most;
    const int m_nameWidth;  // [px]
    QVector<BarButton *> m_buttons;
};

}  // namespace qplc
