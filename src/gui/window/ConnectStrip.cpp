// SPDX-License-Identifier: Apache-2.0
#include "ConnectStrip.h"

#include "BarButton.h"
#include "FoundMasters.h"
#include "gui/plant/AddressResolver.h"
#include "gui/plant/PlantAddress.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

namespace qplc {

ConnectStrip::ConnectStrip(WindowContext *context, QWidget *parent)
    : EntryStrip(context, parent)
    , m_recent(new QWidget)
    , m_recentRow(new QHBoxLayout(m_recent))
    , m_close(new BarButton(BarButton::Quiet, context))
    , m_found(new FoundMasters(QBoxLayout::LeftToRight, 3, context))
    , m_foundRow(makeFoundRow())
{
    setObjectName(QStringLiteral("ConnectStrip"));
    line()->setPlaceholderText(tr("host:port, such as 127.0.0.1:%1").arg(QPlcUnderlyingProtocol::DefaultPort));
    line()->setAccessibleName(tr("Address of the master"));
    line()->setMaximumWidth(360);
    m_recentRow->setContentsMargins(0, 0, 0, 0);
    label()->setText(tr("Connect to a master"));
    auto *connectButton = new BarButton(BarButton::Quiet, context);
    connectButton->setText(tr("Connect"));
    connectButton->setDetail(tr("Enter"));
    m_close->setText(tr("Close"));
    row()->addWidget(connectButton);
    row()->addWidget(m_recent);
    row()->addStretch(1);
    row()->addWidget(m_close);
    column()->insertWidget(1, m_foundRow);
    connect(connectButton, &QAbstractButton::clicked, this, &ConnectStrip::accept);
    connect(m_close, &QAbstractButton::clicked, this, &QWidget::hide);
}

QWidget *ConnectStrip::makeFoundRow()
{
    auto *found = new QWidget;
    auto *parts = new QHBoxLayout(found);
    parts->setContentsMargins(0, 0, 0, 0);
    parts->setSpacing(10);
    parts->addWidget(new QLabel(tr("Running masters:")));
    parts->addWidget(m_found);
    parts->addStretch(1);
    found->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // names of others make no window wider
    found->hide();
    connect(m_found, &FoundMasters::masterChosen, this, &ConnectStrip::choose);
    return found;
}

void ConnectStrip::setFoundMasters(const QVector<FoundMaster> &masters)
{
    m_found->setMasters(masters, m_close, line());
    m_foundRow->setVisible(!masters.isEmpty());
}

void ConnectStrip::choose(const QString &address)
{
    line()->setText(address);
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
        auto *button = new BarButton(BarButton::Link, context());
        button->setText(address);
        connect(button, &QAbstractButton::clicked, this, [this, address] { choose(address); });
        m_recentRow->addWidget(button);
    }
}

void ConnectStrip::open()
{
    showError({});
    show();
    line()->setFocus(Qt::ShortcutFocusReason);
    line()->selectAll();
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
    const QString address = line()->text().trimmed();
    const QString wrong = errorOf(address);
    if (!wrong.isEmpty()) {
        showError(wrong);
        return;
    }
    hide();
    Q_EMIT connectRequested(address);
}

}  // namespace qplc
