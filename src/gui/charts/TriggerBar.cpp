// SPDX-License-Identifier: Apache-2.0
#include "TriggerBar.h"

#include "EventFileEditor.h"
#include "QPlcPanelContext.h"
#include "QPlcTimeAxis.h"
#include "gui/panel/NumberBox.h"
#include "gui/plot/PastRows.h"

#include <QtCore/QSignalBlocker>
#include <QtGui/QResizeEvent>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QWidgetAction>

namespace qplc {

namespace {

constexpr double largestThreshold = 1e12;
constexpr double percent = 100.0;
constexpr int leastWideBar = 520;  // [px]: with less, controls are in the menu
const QString triggerSignalKey = QStringLiteral("signal");
const QString triggerLinkedKey = QStringLiteral("linked");
const QString triggerSaveKey = QStringLiteral("save");

QString stateText(Trigger::State state)
{
    switch (state) {
    case Trigger::Armed:
        return TriggerBar::tr("Waiting");
    case Trigger::Triggered:
        return TriggerBar::tr("Triggered");
    case Trigger::FreeRunning:
        return TriggerBar::tr("No event, live");
    case Trigger::Done:
        return TriggerBar::tr("Done");
    }
    return {};
}

QColor stateColor(Trigger::State state, const QPlcTheme &theme)
{
    return state == Trigger::Triggered ? theme.good : state == Trigger::Armed ? theme.warning : theme.mutedText;
}

}  // namespace

TriggerBar::TriggerBar(QPlcPanelContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
{
    makeControls();
    arrange();
    connect(context, &QPlcPanelContext::signalsChanged, this, &TriggerBar::findSource);
    connect(context, &QPlcPanelContext::themeChanged, this, &TriggerBar::showState);
    connect(context, &QPlcPanelContext::valuesChanged, this, &TriggerBar::takeValues);
    showSettings();
    showState();
}

TriggerBar::~TriggerBar() = default;

void TriggerBar::makeControls()
{
    m_signal = new QComboBox(this);
    m_signal->setAccessibleName(tr("Signal of the trigger"));
    m_signal->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_signal->setMinimumContentsLength(8);
    m_kind = new QComboBox(this);
    m_kind->setAccessibleName(tr("Kind of event"));
    m_kind->addItems(
        {tr("↗ rises"), tr("↘ falls"), tr("↕ crosses"), tr("≥ above"), tr("≤ below"), tr("→ enters"), tr("← leaves")});
    m_level = addNumber(tr("Level"), -largestThreshold, &Trigger::Settings::level);
    m_upperLevel = addNumber(tr("Upper level"), -largestThreshold, &Trigger::Settings::upperLevel);
    m_hysteresis = addNumber(tr("Hysteresis"), 0.0, &Trigger::Settings::hysteresis);
    m_preShare = addNumber(tr("Before the event"), 0.0, &Trigger::Settings::preShare, percent);
    m_preShare->setMaximum(percent);
    m_preShare->setSuffix(tr(" %"));
    m_holdOff = addNumber(tr("Hold-off"), 0.0, &Trigger::Settings::holdOff);
    m_holdOff->setSuffix(tr(" s"));
    m_mode = new QComboBox(this);
    m_mode->setAccessibleName(tr("Mode of the trigger"));
    m_mode->addItems({tr("Auto"), tr("Normal"), tr("Single")});
    m_more = new QToolButton(this);
    m_more->setText(QStringLiteral("…"));
    m_more->setToolTip(tr("Hysteresis, share before the event, hold-off, saving"));
    m_more->setAccessibleName(m_more->toolTip());
    m_more->setPopupMode(QToolButton::InstantPopup);
    m_linked = new QCheckBox(tr("Show the event in all plots"), this);
    m_files = new EventFileEditor(this);
    m_arm = new QToolButton(this);
    m_arm->setText(tr("Arm"));
    m_arm->setToolTip(tr("Forget the events so far and wait for the next one"));
    m_state = new QLabel(this);
    m_count = new QLabel(this);
    const auto activated = QOverload<int>::of(&QComboBox::activated);
    connect(m_signal, activated, this, &TriggerBar::chooseSignal);
    connect(m_kind, activated, this, [this](int kind) { edit(&Trigger::Settings::kind, Trigger::Kind(kind)); });
    connect(m_mode, activated, this, [this](int mode) { edit(&Trigger::Settings::mode, Trigger::Mode(mode)); });
    connect(m_linked, &QCheckBox::toggled, this, &TriggerBar::chooseLink);
    connect(m_files, &EventFileEditor::edited, this, &TriggerBar::begin);
    connect(m_arm, &QToolButton::clicked, this, &TriggerBar::arm);
}

/// \param shown  that a number of 1 is shown as
NumberBox *TriggerBar::addNumber(const QString &name, double minimum, double Trigger::Settings::*number, double shown)
{
    auto *box = new NumberBox(minimum, largestThreshold, this);
    box->setAccessibleName(name);
    box->setToolTip(name);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setFixedWidth(90);
    connect(box, QOverload<double>::of(&NumberBox::valueChanged), this,
            [this, number, shown](double value) { edit(number, value / shown); });
    return box;
}

void TriggerBar::arrange()
{
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    m_row = new QHBoxLayout(this);
    m_row->setContentsMargins(4, 2, 4, 2);
    m_row->setSpacing(4);
    for (QWidget *control :
         std::initializer_list<QWidget *>{m_signal, m_kind, m_level, m_upperLevel, m_mode, m_more, m_arm})
        m_row->addWidget(control);
    m_row->addSpacing(8);
    m_row->addWidget(m_state);
    m_row->addWidget(m_count);
    m_row->addStretch(1);
    fillMenu();
}

void TriggerBar::fillMenu()
{
    auto *rest = new QWidget;
    m_form = new QFormLayout(rest);
    m_form->addRow(tr("Hysteresis"), m_hysteresis);
    m_form->addRow(tr("Before the event"), m_preShare);
    m_form->addRow(tr("Hold-off"), m_holdOff);
    m_form->addRow(m_linked);
    m_form->addRow(m_files);
    auto *menu = new QMenu(this);
    auto *action = new QWidgetAction(menu);
    action->setDefaultWidget(rest);
    menu->addAction(action);
    m_more->setMenu(menu);
}

/// In narrow plots all but the state and what arms it goes into the menu.
void TriggerBar::placeControls(bool isWide)
{
    m_isWide = isWide;
    QWidget *const controls[] = {m_signal, m_kind, m_level, m_upperLevel, m_mode};
    int place = 0;
    for (QWidget *control : controls) {
        if (isWide) {
            const QFormLayout::TakeRowResult line = m_form->takeRow(control);
            delete line.labelItem->widget();
            delete line.labelItem;
            delete line.fieldItem;
            m_row->insertWidget(place++, control);
        } else {
            m_form->insertRow(place++, control->accessibleName(), control);
        }
    }
    m_count->setVisible(isWide);
    showUpperLevel();
}

void TriggerBar::showUpperLevel()
{
    m_upperLevel->setVisible(hasWindow());
    if (QWidget *label = m_form->labelForField(m_upperLevel))
        label->setVisible(hasWindow());
}

void TriggerBar::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    const bool isWide = width() >= leastWideBar;
    if (isWide != m_isWide)
        placeControls(isWide);
}

void TriggerBar::setSignals(const QStringList &expressions)
{
    const QSignalBlocker blocker(m_signal);
    m_signal->clear();
    m_signal->addItems(expressions);
    const QString before = m_wanted;
    if (m_wanted.isEmpty() && !expressions.isEmpty())
        m_wanted = expressions.first();
    if (!m_wanted.isEmpty() && !expressions.contains(m_wanted))
        m_signal->addItem(m_wanted);
    m_signal->setCurrentText(m_wanted);
    if (m_wanted != before)
        findSource();
}

QJsonObject TriggerBar::settings() const
{
    QJsonObject settings = m_trigger.settings().toJson();
    if (!m_wanted.isEmpty())
        settings.insert(triggerSignalKey, m_wanted);
    if (m_isLinked)
        settings.insert(triggerLinkedKey, true);
    const QJsonObject save = m_files->settings().toJson();
    if (!save.isEmpty())
        settings.insert(triggerSaveKey, save);
    return settings;
}

QStringList TriggerBar::keys()
{
    return Trigger::Settings::keys() + QStringList{triggerSignalKey, triggerLinkedKey, triggerSaveKey};
}

QPlcTimeAxis *TriggerBar::time() const
{
    return m_ownTime && !m_isLinked ? m_ownTime : m_context->timeAxis();
}

void TriggerBar::link(bool isLinked)
{
    if (isLinked != m_isLinked)
        release();
    m_isLinked = isLinked;
}

/// What it has frozen, nobody else would bring back.
void TriggerBar::release()
{
    if (m_hasFrozen)
        time()->goLive();
    m_hasFrozen = false;
}

bool TriggerBar::showsEvent() const
{
    const auto view = m_trigger.view();
    return !isHidden() && view && !time()->isLive() && time()->begin() == view->begin;
}

void TriggerBar::applySettings(const QJsonObject &settings)
{
    m_trigger.setSettings(Trigger::Settings::fromJson(settings));
    m_wanted = settings.value(triggerSignalKey).toString();
    link(settings.value(triggerLinkedKey).toBool());
    m_files->show(EventFileSettings::fromJson(settings.value(triggerSaveKey).toObject()));
    if (!m_wanted.isEmpty() && m_signal->findText(m_wanted) < 0)
        m_signal->addItem(m_wanted);
    showSettings();
    findSource();
}

void TriggerBar::showSettings()
{
    const Trigger::Settings &settings = m_trigger.settings();
    m_isFilling = true;
    m_signal->setCurrentText(m_wanted);
    m_kind->setCurrentIndex(settings.kind);
    m_mode->setCurrentIndex(settings.mode);
    m_linked->setChecked(m_isLinked);
    m_level->setValue(settings.level);
    m_upperLevel->setValue(settings.upperLevel);
    m_hysteresis->setValue(settings.hysteresis);
    m_preShare->setValue(percent * settings.preShare);
    m_holdOff->setValue(settings.holdOff);
    m_isFilling = false;
    showUpperLevel();
    m_level->setToolTip(hasWindow() ? tr("Lower level") : tr("Level"));
}

bool TriggerBar::hasWindow() const
{
    return m_trigger.settings().kind == Trigger::EntersWindow || m_trigger.settings().kind == Trigger::LeavesWindow;
}

/// What a person has changed, and nothing else.
template<typename Number>
void TriggerBar::edit(Number Trigger::Settings::*member, Number value)
{
    Trigger::Settings settings = m_trigger.settings();
    if (m_isFilling || settings.*member == value)
        return;
    settings.*member = value;
    m_trigger.setSettings(settings);
    showSettings();
    begin();
}

void TriggerBar::chooseSignal()
{
    if (m_wanted == m_signal->currentText())
        return;
    m_wanted = m_signal->currentText();
    findSource();
    begin();
}

void TriggerBar::chooseLink(bool isLinked)
{
    if (m_isFilling || isLinked == m_isLinked)
        return;
    link(isLinked);
    begin();
}

void TriggerBar::begin()
{
    arm();
    Q_EMIT settingsEdited();
}

void TriggerBar::findSource()
{
    const bool isWanted = !m_wanted.isEmpty() && !isHidden();
    m_source = isWanted ? m_context->past(m_wanted) : QPlcPast();
    m_signal->setToolTip(m_source.problem);
    const QString unit = m_source.unit.isEmpty() ? QString() : QLatin1Char(' ') + m_source.unit;
    for (NumberBox *box : {m_level, m_upperLevel, m_hysteresis})
        box->setSuffix(unit);
    arm();
}

void TriggerBar::arm()
{
    m_trigger.arm();
    m_seenEvent.reset();
    m_awaited.clear();
    Q_EMIT savingBegins();
    if (const PastRows rows = PastRows::of(m_source); rows.store)
        m_trigger.take(*rows.store, rows.channel);
    showState();
    Q_EMIT triggered();
}

void TriggerBar::takeValues()
{
    if (isHidden() || !m_source)
        return;
    m_trigger.setSpan(time()->span());
    tellCompleteEvents();
    const Trigger::State before = m_trigger.state();
    const PastRows rows = PastRows::of(m_source);
    if (!m_trigger.take(*rows.store, rows.channel))
        return;
    if (m_trigger.state() == Trigger::FreeRunning && before != Trigger::FreeRunning)
        time()->goLive();
    showEventView();
    tellCompleteEvents();
    showState();
    Q_EMIT triggered();
}

void TriggerBar::showEventView()
{
    const auto view = m_trigger.view();
    if (!view || m_trigger.shownEvent() == m_seenEvent)
        return;
    m_seenEvent = m_trigger.shownEvent();
    time()->show(view->begin, view->end);
    m_hasFrozen = true;
    if (fileSettings().isOn)
        m_awaited.push_back({*m_seenEvent, *view});
}

void TriggerBar::tellCompleteEvents()
{
    while (!m_awaited.empty() && !m_source.isEmpty()
           && m_source.time(m_source.endRow() - 1) >= m_awaited.front().view.end) {
        const Awaited complete = m_awaited.front();
        m_awaited.pop_front();
        Q_EMIT eventCame(complete.event, complete.view.begin, complete.view.end);
    }
}

const EventFileSettings &TriggerBar::fileSettings() const
{
    return m_files->settings();
}

void TriggerBar::showSaved(int files)
{
    m_saved = files;
    showState();
}

void TriggerBar::showState()
{
    const QString text = m_source ? stateText(m_trigger.state()) : tr("No signal");
    const QColor color = stateColor(m_trigger.state(), m_context->theme());
    m_state->setText(QStringLiteral("<span style='color:%1'>●</span> %2").arg(color.name(), text.toHtmlEscaped()));
    m_state->setToolTip(m_source.problem);
    const QString events = tr("events: %1").arg(m_trigger.count());
    m_count->setText(fileSettings().isOn ? tr("%1, saved: %2").arg(events).arg(m_saved) : events);
}

/// Hidden, it holds no source either.
void TriggerBar::setVisible(bool isVisible)
{
    const bool isOther = isVisible == isHidden();
    QWidget::setVisible(isVisible);
    if (!isOther)
        return;
    if (!isVisible)
        release();
    findSource();
}

}  // namespace qplc
