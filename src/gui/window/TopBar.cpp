// SPDX-License-Identifier: Apache-2.0
#include "TopBar.h"

#include <QtWidgets/QHBoxLayout>

namespace qplc {

namespace {

QString keysOf(Plant::Action action)
{
    switch (action) {
    case Plant::Start:
        return TopBar::tr("F5");
    case Plant::Arm:
        return TopBar::tr("F9");
    case Plant::Reset:
        return TopBar::tr("F7");
    default:
        return TopBar::tr("F4");
    }
}

}  // namespace

QString stopText(const PlantSelection &selection)
{
    const QVector<Plant *> plants = selection.plantsToStop();
    QStringList names;
    for (const Plant *plant : plants)
        names << plant->name();
    return names.size() > 1 ? TopBar::tr("%1?").arg(names.join(QStringLiteral(", "))) : names.join(QString());
}

TopBar::TopBar(PlantSelection *selection, WindowContext *context, QWidget *parent)
    : FlatToolBar(tr("Plant"), context, parent)
    , m_selection(selection)
    , m_selector(new PlantSelector(selection, context))
    , m_stepper(new StateStepper(context))
    , m_next(new BarButton(BarButton::Primary, context))
    , m_control(new ControlNotice(context))
    , m_stop(new BarButton(BarButton::Stop, context))
{
    setObjectName(QStringLiteral("TopBar"));
    m_stop->setText(tr("STOP"));
    m_stop->setToolTip(tr("Stops the plant at once (Esc Esc, or Ctrl+.)"));

    auto *content = new QWidget(this);
    auto *row = new QHBoxLayout(content);
    row->setContentsMargins(6, 4, 6, 4);
    row->setSpacing(14);
    row->addWidget(m_selector);
    row->addWidget(m_stepper);
    row->addWidget(m_next);
    row->addWidget(m_control);  // it expands; with a stretch it would be the only one that gives way
    row->addWidget(m_stop);
    addWidget(content);
    // Nothing in the bar moves when the next thing to do is another one, or none.
    m_next->setText(Plant::actionText(Plant::Initialize));
    m_next->setDetail(tr("F4"));
    m_next->setMinimumWidth(m_next->sizeHint().width());
    QSizePolicy kept = m_next->sizePolicy();
    kept.setRetainSizeWhenHidden(true);
    m_next->setSizePolicy(kept);

    connect(m_next, &QAbstractButton::clicked, this, &TopBar::nextRequested);
    connect(m_stop, &QAbstractButton::clicked, this, &TopBar::stopRequested);
    connect(selection, &PlantSelection::changed, this, &TopBar::follow);
    follow();
}

void TopBar::follow()
{
    const Plant *plant = m_selection->plant();
    m_stepper->show(StateStep::of(plant, m_selection->isInitialized()));
    const Plant::Action next = plant ? plant->nextAction() : Plant::NoAction;
    // While cycles run, STOP is the next action.
    const bool hasNext = next != Plant::NoAction && next != Plant::StopAction;
    m_next->setVisible(hasNext);
    if (hasNext) {
        m_next->setText(Plant::actionText(next));
        m_next->setDetail(keysOf(next));
        m_next->setToolTip(tr("%1 %2").arg(Plant::actionText(next), plant->name()));
    }
    const QString toStop = stopText(*m_selection);
    m_stop->setDetail(m_selection->plants()->size() > 1 ? toStop : QString());
    m_stop->setAccessibleName(toStop.isEmpty() ? tr("Stop") : tr("Stop %1").arg(toStop));
}

}  // namespace qplc
