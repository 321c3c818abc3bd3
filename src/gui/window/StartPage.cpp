// SPDX-License-Identifier: Apache-2.0
#include "StartPage.h"

#include "BarButton.h"
#include "FoundMasters.h"
#include "StartButton.h"

#include <QtGui/QPainter>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLabel>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace qplc {

namespace {

constexpr int columnWidth = 520;  // [px]
constexpr int mostFound = 5;      // qtplc find shows more

}  // namespace

StartPage::StartPage(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_title(new QLabel)
    , m_sentence(new QLabel(tr("See, steer and understand a running plant.")))
    , m_foundTitle(new QLabel)
    , m_recentTitle(new QLabel(tr("Recent plants")))
    , m_actions(new QVBoxLayout)
    , m_ways(new QVBoxLayout)
    , m_found(new FoundMasters(QBoxLayout::TopToBottom, mostFound, context))
    , m_recent(new QVBoxLayout)
{
    setObjectName(QStringLiteral("StartPage"));
    m_title->setText(QApplication::applicationDisplayName() == QApplication::applicationName()
                         ? tr("Control Center")
                         : QApplication::applicationDisplayName());
    m_actions->setSpacing(10);
    m_ways->setSpacing(10);
    m_ways->addLayout(m_actions);
    m_recent->setSpacing(2);
    // What is found and remembered has the room below for itself: as it grows, nothing above moves
    // under the mouse.
    auto *content = new QWidget;
    auto *page = new QVBoxLayout(content);
    page->addStretch(2);
    page->addWidget(makeHead(), 0, Qt::AlignHCenter);
    page->addSpacing(22);
    page->addWidget(makeMasters(), 3, Qt::AlignHCenter);
    // Many actions must not make the window higher than a small screen.
    auto *scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setFocusPolicy(Qt::NoFocus);
    scroll->setWidgetResizable(true);
    scroll->setWidget(content);
    for (QWidget *see : {static_cast<QWidget *>(content), scroll->viewport()})
        see->setAutoFillBackground(false);
    auto *frame = new QVBoxLayout(this);
    frame->setContentsMargins(0, 0, 0, 0);
    frame->addWidget(scroll);
    m_recentTitle->hide();
    setFoundMasters({});
    connect(m_found, &FoundMasters::masterChosen, this, &StartPage::masterChosen);
    connect(context, &WindowContext::themeChanged, this, &StartPage::follow);
    follow();
}

namespace {

QVBoxLayout *columnOf(QWidget *widget)
{
    widget->setFixedWidth(columnWidth);
    auto *column = new QVBoxLayout(widget);
    column->setContentsMargins(0, 0, 0, 0);
    return column;
}

}  // namespace

QWidget *StartPage::makeHead()
{
    auto *head = new QWidget;
    QVBoxLayout *column = columnOf(head);
    column->addWidget(m_title);
    column->addWidget(m_sentence);
    column->addSpacing(22);
    column->addLayout(m_ways);
    return head;
}

QWidget *StartPage::makeMasters()
{
    auto *masters = new QWidget;
    QVBoxLayout *column = columnOf(masters);
    column->addWidget(m_foundTitle);
    column->addWidget(m_found);
    column->addSpacing(14);
    column->addWidget(m_recentTitle);
    column->addLayout(m_recent);
    column->addStretch(1);
    return masters;
}

void StartPage::follow()
{
    QFont big = font();
    big.setPointSizeF(big.pointSizeF() * 2.2);
    m_title->setFont(big);
    QPalette muted = palette();
    muted.setColor(QPalette::WindowText, m_context->theme().mutedText);
    m_sentence->setPalette(muted);
    m_foundTitle->setPalette(muted);
    m_recentTitle->setPalette(muted);
    update();
}

void StartPage::addAction(QAction *action)
{
    insertAction(m_actions->count() - m_ownActions, action);
}

void StartPage::addOwnAction(QAction *action)
{
    ++m_ownActions;
    insertAction(m_actions->count(), action);
}

void StartPage::insertAction(int place, QAction *action)
{
    m_actions->insertWidget(place, new StartButton(action, m_context));
    for (int each = 0; each < m_actions->count(); ++each) {
        auto *button = static_cast<StartButton *>(m_actions->itemAt(each)->widget());
        button->setRank(each == 0 ? StartButton::First : StartButton::Other);
        if (each > 0)
            setTabOrder(m_actions->itemAt(each - 1)->widget(), button);
        else
            setFocusProxy(button);
    }
}

void StartPage::setWayBack(QAction *action)
{
    m_back = new StartButton(action, m_context);
    m_back->setRank(StartButton::Other);
    m_back->hide();
    m_ways->addWidget(m_back);
}

void StartPage::showWayBack(bool isShown)
{
    m_back->setVisible(isShown);
}

/// The last big button; this page when there is none yet.
QWidget *StartPage::lastAction()
{
    if (m_back && !m_back->isHidden())
        return m_back;
    return m_actions->count() == 0 ? this : m_actions->itemAt(m_actions->count() - 1)->widget();
}

void StartPage::setRecentMasters(const QStringList &addresses)
{
    while (QLayoutItem *item = m_recent->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    m_recentTitle->setVisible(!addresses.isEmpty());
    for (const QString &address : addresses) {
        auto *button = new BarButton(BarButton::Link, m_context);
        button->setText(address);
        button->setAccessibleName(tr("Connect to %1").arg(address));
        connect(button, &QAbstractButton::clicked, this, [this, address] { Q_EMIT masterChosen(address); });
        m_recent->addWidget(button, 0, Qt::AlignLeft);
    }
}

void StartPage::setFoundMasters(const QVector<FoundMaster> &masters)
{
    m_found->setMasters(masters, lastAction(), this);
    m_found->setVisible(!masters.isEmpty());
    m_foundTitle->setText(masters.isEmpty() ? tr("No running master has been found yet.") : tr("Running masters"));
}

QList<QWidget *> StartPage::buttons() const
{
    QList<QWidget *> all;
    for (QAbstractButton *button : findChildren<QAbstractButton *>()) {
        if (!button->isHidden())
            all.append(button);
    }
    return all;
}

void StartPage::paintEvent(QPaintEvent * /*event*/)
{
    QPainter(this).fillRect(rect(), m_context->theme().window);
}

}  // namespace qplc
