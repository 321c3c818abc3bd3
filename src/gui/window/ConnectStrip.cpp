// SPDX-License-Identifier: Apache-2.0
#include "ConnectStrip.h"

#include "BarButton.h"
#include "FoundMasters.h"
#include "gui/plant/AddressResolver.h"
#include "gui/plant/PlantAddress.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

namespace qplc {

ConnectStrip::ConnectStrip(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_address(new QLineEdit)
    , m_recent(new QWidget)
    , m_recentRow(new QHBoxLayout(m_recent))
    , m_close(new BarButton(BarButton::Quiet, context))
    , m_found(new FoundMasters(QBoxLayout::LeftToRight, 3, context))
    , m_foundRow(makeFoundRow())
    , m_error(new QLabel)
{
    setObjectName(QStringLiteral("ConnectStrip"));
    m_address->setPlaceholderText(tr("host:port, such as 127.0.0.1:%1").arg(QPlcUnderlyingProtocol::DefaultPort));
    m_address->setAccessibleName(tr("Address of the master"));
    m_address->setMaximumWidth(360);
    m_error->setWordWrap(true);
    m_recentRow->setContentsMargins(0, 0, 0, 0);
    auto *label = new QLabel(tr("Connect to a master"));
    label->setBuddy(m_address);
    auto *connectButton = new BarButton(BarButton::Quiet, context);
    connectButton->setText(tr("Connect"));
    connectButton->setDetail(tr("Enter"));
    m_close->setText(tr("Close"));
    auto *row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(label);
    row->addWidget(m_address, 1);
    row->addWidget(connectButton);
    row->addWidget(m_recent);
    row->addStretch(1);
    row->addWidget(m_close);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(14, 8, 6, 8);
    column->setSpacing(2);
    column->addLayout(row);
    column->addWidget(m_foundRow);
    column->addWidget(m_error);
    m_error->hide();
    connect(m_address, &QLineEdit::returnPressed, this, &ConnectStrip::accept);
    connect(m_address, &QLineEdit::textEdited, m_error, &QWidget::hide);
    connect(connectButton, &QAbstractButton::clicked, this, &ConnectStrip::accept);
    connect(m_close, &QAbstractButton::clicked, this, &QWidget::hide);
    hide();
}

QWidget *ConnectStrip::makeFoundRow()
{
    auto *line = new QWidget;
    auto *row = new QHBoxLayout(line);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(10);
    row->addWidget(new QLabel(tr("Running masters:")));
    row->addWidget(m_found);
    row->addStretch(1);
    line->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // names of others make no window wider
    line->hide();
    connect(m_found, &FoundMasters::masterChosen, this, &ConnectStrip::choose);
    return line;
}

void ConnectStrip::setFoundMasters(const QVector<FoundMaster> &masters)
{
    m_found->setMasters(masters, m_close, m_address);
    m_foundRow->setVisible(!masters.isEmpty());
}

void ConnectStrip::choose(const QString &address)
{
    m_address->setText(address);
    accept();
}

void ConnectStrip::setRecentMasters(const QStringList &addresses)
{
    constexpr int most = 4;
    while (QLayoutItem *item = m_recentRow->takeAt(0)) {
        if (item->widget())
            item->widget()->deleteLater();
        delete item;
    }
    if (!addresses.isEmpty())
        m_recentRow->addWidget(new QLabel(tr("Recent:")));
    for (const QString &address : addresses.mid(0, most)) {
        auto *button = new BarButton(BarButton::Link, m_context);
        button->setText(address);
        connect(button, &QAbstractButton::clicked, this, [this, address] { choose(address); });
        m_recentRow->addWidget(button);
    }
}

void ConnectStrip::open()
{
    m_error->hide();
    show();
    m_address->setFocus(Qt::ShortcutFocusReason);
    m_address->selectAll();
}

void ConnectStrip::showError(const QString &sentence)
{
    QPalette alarm = palette();
    alarm.setColor(QPalette::WindowText, m_context->theme().alarm);
    m_error->setPalette(alarm);
    m_error->setText(sentence);
    m_error->show();
}

QString ConnectStrip::error() const
{
    return m_error->isHidden() ? QString() : m_error->text();
}

QString ConnectStrip::errorOf(const QString &address)
{
    if (address.trimmed().isEmpty())
        return tr("Give the address of a master, such as 127.0.0.1:%1.").arg(QPlcUnderlyingProtocol::DefaultPort);
    QString error;
    QString plain = PlantAddress::fromString(address, &error).master;
    // Names of hosts are looked up later, in the background.
    if (!error.isEmpty() || !AddressResolver::hostToLookUp(plain).isEmpty()
        || plain.contains(QLatin1String("local://")))
        return error;
    if (plain.startsWith(QLatin1String("qtplc://")))
        plain.remove(0, 8);
    QPlcUnderlyingProtocol::fromString(plain, QPlcUnderlyingProtocol::Automatic, &error);
    return error;
}

void ConnectStrip::accept()
{
    const QString address = m_address->text().trimmed();
    const QString wrong = errorOf(address);
    if (!wrong.isEmpty()) {
        showError(wrong);
        return;
    }
    hide();
    Q_EMIT connectRequested(address);
}

void ConnectStrip::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        hide();
    else
        QWidget::keyPressEvent(event);
}

void ConnectStrip::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.fillRect(rect(), m_context->theme().surface);
    painter.fillRect(QRect(0, height() - 1, width(), 1), m_context->theme().line);
}

}  // namespace qplc
