// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QAbstractButton>

class QAction;

namespace qplc {

/// A big button for an action: icon, text, its keys, and the tool tip as a sentence below.
class StartButton : public QAbstractButton
{
    Q_OBJECT
public:
    enum Rank { First, Other };

    /// \param action, context  outlive the button, or take it out of service by their end
    StartButton(QAction *action, WindowContext *context, QWidget *parent = nullptr);
    void setRank(Rank rank);

    QSize sizeHint() const override { return {460, 68}; }

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();

    QAction *m_action;
    Rank m_rank = Other;
    WindowContext *m_context;
    QString m_sentence;
    QString m_keys;
};

}  // namespace qplc
