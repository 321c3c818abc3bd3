// SPDX-License-Identifier: Apache-2.0
#include "ToggleView.h"

#include "SwitchButton.h"

#include <QtWidgets/QHBoxLayout>

#include <cmath>

namespace qplc {

ToggleView::ToggleView(SetterTarget *target, QWidget *parent)
    : SetterView(target, parent)
    , m_switch(new SwitchButton(this))
{
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_switch);
    row->addStretch();
    m_switch->setAccessibleName(tr("On or off"));
    setFocusProxy(m_switch);
    connect(m_switch, &QAbstractButton::clicked, this, &ToggleView::clicked);
    refresh();
}

void ToggleView::refresh()
{
    m_switch->setEnabled(target().control().mayWrite() && target().isNumber());
    showActual();
}

void ToggleView::showActual()
{
    if (m_waits > 0) {
        --m_waits;
        return;
    }
    const double actual = target().actualNumber();
    const double off = target().neutral();
    m_switch->setChecked(!std::isnan(actual) && std::abs(actual - m_on) < std::abs(actual - off));
}

void ToggleView::clicked()
{
    m_waits = 3;
    target().sendOnce(m_switch->isChecked() ? m_on : target().neutral());
}

QJsonObject ToggleView::settings() const
{
    return m_on != 1.0 ? QJsonObject{{QStringLiteral("on"), m_on}} : QJsonObject();
}

void ToggleView::applySettings(const QJsonObject &settings)
{
    m_on = settings.value(QStringLiteral("on")).toDouble(1.0);
    refresh();
}

}  // namespace qplc
