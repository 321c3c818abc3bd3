// SPDX-License-Identifier: Apache-2.0
#include "ControlNotice.h"

#include "WatchPlants.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>

namespace qplc {

namespace {

constexpr int barWidth = 4;   // [px] of the coloured bar
constexpr int textLeft = 12;  // [px]
constexpr int textRight = 8;  // [px] between the text and the button

}  // namespace

ControlNotice::ControlNotice(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_giveBack(new BarButton(BarButton::Outlined, context))
{
    setObjectName(QStringLiteral("ControlNotice"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_giveBack->setText(tr("Give back"));
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addStretch();
    row->addWidget(m_giveBack);
    PlantList *plants = context->plants();
    connect(m_giveBack, &QAbstractButton::clicked, this, [plants] { giveBackControl(*plants); });
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
    watchPlants(plants, this, &ControlNotice::follow, &Plant::leasesChanged);
}

void ControlNotice::follow()
{
    m_facts = ControlFact::of(*m_context->plants());
    QStringList sentences;
    for (const ControlFact &fact : qAsConst(m_facts))
        sentences << QStringLiteral("%1. %2").arg(fact.sentence(), fact.remedy());
    setToolTip(sentences.join(QLatin1Char('\n')));
    setAccessibleName(sentences.join(QLatin1Char(' ')));
    m_giveBack->setVisible(isToGiveBack());
    if (isToGiveBack())
        m_giveBack->setAccessibleName(tr("Give back %1").arg(m_facts.first().references.join(QStringLiteral(", "))));
    update();
    Q_EMIT factsChanged();
}

/// What others hold is theirs: it is taken where it is seen.
bool ControlNotice::isToGiveBack() const
{
    return !m_facts.isEmpty() && m_facts.first().kind != ControlFact::Others;
}

QStringList ControlNotice::lines() const
{
    if (m_facts.isEmpty())
        return {};
    const ControlFact &first = m_facts.first();
    if (m_facts.size() == 1)
        return {first.headline(), first.references.join(QStringLiteral(", "))};
    const QString more = m_facts.size() > 2 ? tr(" (and %1 more)").arg(m_facts.size() - 2) : QString();
    return {first.sentence(), m_facts.at(1).sentence() + more};
}

QRect ControlNotice::textRect() const
{
    const int right = m_giveBack->isHidden() ? width() : m_giveBack->x() - textRight;
    return {textLeft, 3, right - textLeft, 38};
}

QColor ControlNotice::colorOf(const ControlFact &fact) const
{
    const Theme &theme = m_context->theme();
    return fact.kind == ControlFact::Lost ? theme.warning : theme.held;
}

void ControlNotice::paintEvent(QPaintEvent * /*event*/)
{
    if (m_facts.isEmpty())
        return;
    const Theme &theme = m_context->theme();
    const QStringList texts = lines();
    const QColor color = colorOf(m_facts.first());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawRoundedRect(QRectF(0, 3, barWidth, height() - 6), 2, 2);
    const auto drawLine = [&](int top, const QString &text, const QColor &ink, bool isBold) {
        QFont used = font();
        used.setBold(isBold);
        painter.setFont(used);
        painter.setPen(ink);
        const QRect place(textLeft, top, textRect().width(), 19);
        painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter,
                         QFontMetrics(used).elidedText(text, Qt::ElideRight, place.width()));
    };
    drawLine(3, texts.at(0), color, true);
    drawLine(22, texts.at(1), m_facts.size() > 1 ? colorOf(m_facts.at(1)) : theme.text, false);
}

}  // namespace qplc
