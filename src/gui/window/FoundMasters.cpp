// SPDX-License-Identifier: Apache-2.0
#include "FoundMasters.h"

#include "BarButton.h"

#include <QtGui/QKeyEvent>
#include <QtWidgets/QApplication>

#include <algorithm>

namespace qplc {

FoundMasters::FoundMasters(QBoxLayout::Direction direction, int most, WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_layout(new QBoxLayout(direction, this))
    , m_most(most)
    , m_nameWidth(direction == QBoxLayout::TopToBottom ? 200 : 140)
{
    m_layout->setContentsMargins(0, 0, 0, 0);
    m_layout->setSpacing(2);
}

BarButton *FoundMasters::buttonOf(const QString &address) const
{
    const auto found = std::find_if(m_buttons.begin(), m_buttons.end(),
                                    [&](const BarButton *button) { return button->objectName() == address; });
    return found == m_buttons.end() ? nullptr : *found;
}

BarButton *FoundMasters::makeButton(const QString &address)
{
    auto *button = new BarButton(BarButton::Link, m_context, this);
    button->setObjectName(address);
    connect(button, &QAbstractButton::clicked, this, [this, address] { Q_EMIT masterChosen(address); });
    return button;
}

void FoundMasters::describe(BarButton *button, const FoundMaster &master) const
{
    const QString place = master.isLocal ? tr("this computer")
        : master.isSecured               ? tr("network")
                                         : tr("network, insecure");
    button->setText(fontMetrics().elidedText(master.name, Qt::ElideMiddle, m_nameWidth));
    button->setShortcut(QKeySequence());  // an '&' that somebody has sent takes no keys
    button->setDetail(tr("%1, %2").arg(master.address, place));
    button->setAccessibleName(tr("Connect to %1 at %2, %3").arg(master.name, master.address, place));
    button->setFixedWidth(button->sizeHint().width());
}

void FoundMasters::removeAllBut(const QVector<FoundMaster> &masters)
{
    const auto isGone = [&](const BarButton *button) {
        return std::none_of(masters.begin(), masters.end(),
                            [&](const FoundMaster &master) { return master.address == button->objectName(); });
    };
    for (int place = m_buttons.size() - 1; place >= 0; --place) {
        if (isGone(m_buttons[place]))
            delete m_buttons.takeAt(place);
    }
}

bool FoundMasters::hasFocusWithin() const
{
    return isAncestorOf(QApplication::focusWidget());
}

void FoundMasters::setMasters(const QVector<FoundMaster> &masters, QWidget *before, QWidget *refuge)
{
    const bool hadFocus = hasFocusWithin();
    const QVector<FoundMaster> wanted = masters.mid(0, m_most);
    removeAllBut(wanted);
    QVector<BarButton *> buttons;
    for (const FoundMaster &master : wanted) {
        BarButton *button = buttonOf(master.address);
        if (!button)
            button = makeButton(master.address);
        if (!m_buttons.contains(button))
            m_buttons.append(button);
        describe(button, master);
        m_layout->removeWidget(button);
        m_layout->addWidget(button, 0, Qt::AlignLeft);
        setTabOrder(before, button);
        before = button;
        buttons.append(button);
    }
    m_buttons = buttons;
    if (hadFocus && !hasFocusWithin())
        refuge->setFocus(Qt::OtherFocusReason);
}

void FoundMasters::keyPressEvent(QKeyEvent *event)
{
    const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    auto *button = qobject_cast<BarButton *>(focusWidget());
    if (isEnter && button && button->hasFocus())
        button->click();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace qplc
