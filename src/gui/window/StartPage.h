// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"
#include "node/session/MasterFinder.h"

#include <QtWidgets/QWidget>

class QAction;
class QLabel;
class QVBoxLayout;

namespace qplc {

class FoundMasters;
class StartButton;

/// What a window without a plant shows: a few big things to begin with, which masters there are,
/// and where one was before.
class StartPage : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the page
    explicit StartPage(WindowContext *context, QWidget *parent = nullptr);

    /// A big button before those of the window. \param action owned by others; text, icon, and
    /// toolTip as a sentence below the text
    void addAction(QAction *action);
    /// A big button of the window, behind all that are there. \param action  as above
    void addOwnAction(QAction *action);
    /// The big button below all others, which leads back to the panels; hidden until showWayBack().
    /// \param action owned by others
    void setWayBack(QAction *action);
    void showWayBack(bool isShown);
    /// Addresses, newest first.
    void setRecentMasters(const QStringList &addresses);
    void setFoundMasters(const QVector<FoundMaster> &masters);
    QList<QWidget *> buttons() const;

Q_SIGNALS:
    void masterChosen(const QString &address);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    QWidget *makeHead();
    QWidget *makeMasters();
    void follow();
    void insertAction(int place, QAction *action);
    QWidget *lastAction();

    WindowContext *m_context;
    QLabel *m_title;
    QLabel *m_sentence;
    QLabel *m_foundTitle;
    QLabel *m_recentTitle;
    QVBoxLayout *m_actions;
    QVBoxLayout *m_ways;  // m_actions, and the way back
    int m_ownActions = 0;
    StartButton *m_back = nullptr;
    FoundMasters *m_found;
    QVBoxLayout *m_recent;
};

}  // namespace qplc
