// SPDX-License-Identifier: Apache-2.0
#include "PlantSelector.h"

#include "BarButton.h"
#include "PlantSummary.h"

#include <QtCore/QTimer>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtWidgets/QMenu>

namespace qplc {

namespace {

constexpr int refreshPause = 250;  // [ms] of ages and of what is left until the next attempt
constexpr int nameLeft = 28;       // [px]

/// "Profile Simulation: no real devices, and the master listens on this computer only"; empty
/// before the master has told it.
QString profileText(const Plant *plant)
{
    if (!plant || !plant->isConnected() || plant->status().master.profile.isEmpty())
        return {};
    const messages::State &master = plant->status().master;
    return PlantSelector::tr("Profile %1: %2").arg(master.profile, master.profileReason);
}

}  // namespace

PlantSelector::PlantSelector(PlantSelection *selection, WindowContext *context, QWidget *parent)
    : QAbstractButton(parent)
    , m_selection(selection)
    , m_context(context)
{
    setFocusPolicy(Qt::TabFocus);
    setCursor(Qt::PointingHandCursor);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    m_clock.start();
    auto *timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, &PlantSelector::follow);
    timer->start(refreshPause);
    connect(selection, &PlantSelection::changed, this, &PlantSelector::follow);
    connect(selection->plants(), &PlantList::removed, this, [this](Plant *plant) { m_watches.remove(plant); });
    connect(context, &WindowContext::themeChanged, this, &PlantSelector::follow);
    connect(this, &QAbstractButton::clicked, this, &PlantSelector::openMenu);
    follow();
}

void PlantSelector::watchViolations()
{
    const PlantList *plants = m_selection->plants();
    for (const Plant *plant : plants->all()) {
        if (plant->isConnected() && plant->status().isCounted)
            m_watches[plant].take(ViolationWatch::totalOf(plant->status()), m_clock.elapsed());
        else
            m_watches.remove(plant);
    }
}

void PlantSelector::follow()
{
    watchViolations();
    const Plant *plant = m_selection->plant();
    QString name = tr("No plant");
    PlantSummary summary{Tone::Calm, tr("not connected"), tr("Connect to one (Ctrl+O)"), {}};
    if (plant) {
        name = plant->name();
        summary = PlantSummary::of(*plant, m_watches.value(plant));
    }
    const QColor color = colorOf(m_context->theme(), summary.tone);
    const QColor plantColor
        = plant && m_selection->plants()->size() > 1 ? m_context->theme().plant(plant->number()) : QColor();
    const QString profile = profileText(plant);
    if (profile == m_profile && name == m_name && plantColor == m_plantColor && summary.condition == m_headline
        && summary.figures == m_figures && summary.violations == m_violations && color == m_color)
        return;
    m_name = name;
    m_plantColor = plantColor;
    m_headline = summary.condition;
    m_figures = summary.figures;
    m_violations = summary.violations;
    m_profile = profile;
    m_color = color;
    setText(QStringLiteral("%1: %2").arg(m_name, m_headline));
    setAccessibleName(tr("Plant %1: %2. %3").arg(m_name, m_headline, m_figures));
    setAccessibleDescription(m_profile);
    setToolTip(m_profile.isEmpty() ? m_figures : m_figures + QLatin1Char('\n') + m_profile);
    update();
}

void PlantSelector::openMenu()
{
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    PlantList *plants = m_selection->plants();
    for (Plant *plant : plants->all()) {
        QAction *action
            = menu->addAction(QStringLiteral("%1   %2").arg(plant->name(), PlantSummary::of(*plant).condition));
        action->setCheckable(true);
        action->setChecked(plant == m_selection->plant());
        QPixmap patch(16, 16);
        patch.fill(m_context->theme().plant(plant->number()));
        action->setIcon(patch);
        connect(action, &QAction::triggered, m_selection, [this, plant] { m_selection->select(plant); });
    }
    menu->addSeparator();
    menu->addActions(m_actions);
    menu->popup(mapToGlobal(QPoint(0, height())));
}

/// In one colour, but for violations that are new.
void PlantSelector::drawFigures(QPainter *painter, const QRect &place)
{
    const Theme &theme = m_context->theme();
    const QFontMetrics size = painter->fontMetrics();
    const QString shown = size.elidedText(m_figures, Qt::ElideRight, place.width());
    painter->setPen(theme.mutedText);
    painter->drawText(place, Qt::AlignLeft | Qt::AlignVCenter, shown);
    const int begin = m_violations.isEmpty() ? -1 : shown.indexOf(m_violations);
    if (begin < 0)
        return;
    QRect part = place;
    part.setLeft(place.left() + size.horizontalAdvance(shown.left(begin)));
    painter->fillRect(QRect(part.left(), part.top(), size.horizontalAdvance(m_violations), part.height()),
                      underMouse() ? theme.window : theme.surface);
    painter->setPen(theme.warning);
    painter->drawText(part, Qt::AlignLeft | Qt::AlignVCenter, m_violations);
}

QSize PlantSelector::sizeHint() const
{
    return {440, 44};
}

QSize PlantSelector::minimumSizeHint() const
{
    return {220, 44};
}

void PlantSelector::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme.line, 1.0));
    painter.setBrush(underMouse() ? theme.window : theme.surface);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
    if (m_plantColor.isValid()) {  // the colour that panels of this plant have behind its name
        QPainterPath frame;
        frame.addRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
        painter.save();
        painter.setClipPath(frame);
        painter.fillRect(QRect(0, 0, 6, height()), m_plantColor);
        painter.restore();
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(m_color);
    painter.drawEllipse(QPointF(15, 15), 5, 5);

    const int right = width() - 24;
    QFont bold = font();
    bold.setBold(true);
    const QFontMetrics boldSize(bold);
    const QString name = boldSize.elidedText(m_name, Qt::ElideMiddle, (right - nameLeft) * 6 / 10);
    painter.setFont(bold);
    painter.setPen(theme.text);
    painter.drawText(QRect(nameLeft, 4, right - nameLeft, 20), Qt::AlignLeft | Qt::AlignVCenter, name);
    const int conditionLeft = nameLeft + boldSize.horizontalAdvance(name) + 10;
    painter.setFont(font());
    painter.setPen(m_color);
    const QRect conditionRect(conditionLeft, 4, right - conditionLeft, 20);
    painter.drawText(conditionRect, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(m_headline, Qt::ElideRight, conditionRect.width()));

    QFont smaller = font();
    smaller.setPointSizeF(smaller.pointSizeF() * 0.9);
    painter.setFont(smaller);
    drawFigures(&painter, QRect(nameLeft, 23, right - nameLeft, 17));
    painter.setPen(QPen(theme.mutedText, 1.5));
    painter.drawPolyline(QPolygonF(QVector<QPointF>{{width() - 18.0, height() / 2 - 2.0},
                                                    {width() - 13.5, height() / 2 + 2.5},
                                                    {width() - 9.0, height() / 2 - 2.0}}));
    if (hasFocus())
        drawFocusRing(&painter, rect(), theme);
}

}  // namespace qplc
