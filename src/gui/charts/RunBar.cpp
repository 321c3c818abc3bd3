// SPDX-License-Identifier: Apache-2.0
#include "RunBar.h"

#include "PlotRuns.h"
#include "QPlcPanelContext.h"
#include "QPlcTheme.h"
#include "gui/panel/NumberBox.h"

#include <QtCore/QSignalBlocker>
#include <QtGui/QResizeEvent>
#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QSpinBox>
#include <QtWidgets/QToolButton>

#include <algorithm>

namespace qplc {

namespace {

constexpr double largestLevel = 1e12;
constexpr double longestApart = 86400.0;  // [s]
constexpr int leastWideRunBar = 900;      // [px]: with less, there are two lines
constexpr int leastBarWithAll = 480;      // [px]
constexpr int widthOfLevel = 90;          // [px]
constexpr int widthOfApart = 64;

}  // namespace

RunBar::RunBar(QPlcPanelContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
{
    makeControls();
    arrange();
}

void RunBar::makeControls()
{
    m_plants = new QToolButton(this);
    m_plants->setAccessibleName(tr("Runs that lie over this one"));
    m_plants->setToolTip(m_plants->accessibleName());
    m_plants->setPopupMode(QToolButton::InstantPopup);
    m_menu = new QMenu(this);
    m_plants->setMenu(m_menu);
    connect(m_menu, &QMenu::aboutToShow, this, &RunBar::fillPlants);
    m_alignment = new QComboBox(this);
    m_alignment->setAccessibleName(tr("How runs are aligned"));
    m_alignment->addItems({tr("from their begins"), tr("at the same time"), tr("where this rises:"),
                           tr("where this happens:"), tr("after each pause")});
    m_edges = new QWidget(this);
    m_signal = new QComboBox(m_edges);
    m_signal->setAccessibleName(tr("Signal whose edges begin a run"));
    m_signal->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_signal->setMinimumContentsLength(8);
    m_event = new QComboBox(m_edges);
    m_event->setAccessibleName(tr("Event that begins a run"));
    m_event->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_event->setMinimumContentsLength(16);
    m_event->installEventFilter(this);
    m_to = new QLabel(tr("to"), m_edges);
    m_level = new NumberBox(-largestLevel, largestLevel, m_edges);
    m_level->setAccessibleName(tr("Level that it rises to"));
    m_level->setFixedWidth(widthOfLevel);
    m_last = new QSpinBox(m_edges);
    m_last->setAccessibleName(tr("How many of the last ones"));
    m_last->setRange(1, RunSettings::MostLast);
    m_last->setPrefix(tr("last "));
    m_apart = new NumberBox(0.0, longestApart, m_edges);
    m_apart->setAccessibleName(tr("An edge that comes sooner after the one before does not count"));
    m_apart->setSuffix(tr(" s"));
    m_apart->setFixedWidth(widthOfApart);
    for (NumberBox *box : {m_level, m_apart})
        box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    for (QWidget *control : std::initializer_list<QWidget *>{m_alignment, m_signal, m_event, m_level, m_last, m_apart})
        control->setToolTip(control->accessibleName());
    m_difference = new QToolButton(this);
    m_difference->setText(tr("Differences"));
    m_difference->setCheckable(true);
    m_difference->setToolTip(tr("Shows each run minus the one below"));
    connect(m_difference, &QToolButton::toggled, this,
            [this](bool isChecked) { edit(&RunSettings::isDifference, isChecked); });
    m_apartLabel = new QLabel(tr("apart"), m_edges);
    m_state = new QLabel(this);
    m_state->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_close = new QToolButton(this);
    m_close->setText(QStringLiteral("×"));
    m_close->setToolTip(tr("Compare no runs (C)"));
    m_close->setAccessibleName(m_close->toolTip());
    const auto activated = QOverload<int>::of(&QComboBox::activated);
    connect(m_alignment, activated, this,
            [this](int place) { edit(&RunSettings::alignment, RunSettings::Alignment(place)); });
    connect(m_signal, activated, this, [this] { edit(&RunSettings::signal, m_signal->currentText()); });
    connect(m_event, activated, this, [this] { edit(&RunSettings::event, m_event->currentText()); });
    connect(m_level, QOverload<double>::of(&NumberBox::valueChanged), this,
            [this](double value) { edit(&RunSettings::level, value); });
    connect(m_apart, QOverload<double>::of(&NumberBox::valueChanged), this,
            [this](double value) { edit(&RunSettings::apart, value); });
    connect(m_last, QOverload<int>::of(&QSpinBox::valueChanged), this,
            [this](int value) { edit(&RunSettings::last, value); });
    connect(m_close, &QToolButton::clicked, this, [this] { edit(&RunSettings::isOn, false); });
}

void RunBar::arrange()
{
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    auto *edges = new QHBoxLayout(m_edges);
    edges->setContentsMargins(0, 0, 0, 0);
    edges->setSpacing(4);
    edges->addWidget(m_signal);
    edges->addWidget(m_event);
    edges->addWidget(m_to);
    edges->addWidget(m_level);
    edges->addWidget(m_last);
    edges->addWidget(m_apartLabel);
    edges->addWidget(m_apart);
    edges->addStretch(1);
    m_grid = new QGridLayout(this);
    m_grid->setContentsMargins(4, 2, 4, 2);
    m_grid->setSpacing(4);
    m_grid->addWidget(m_plants, 0, 0);
    m_grid->addWidget(m_alignment, 0, 1);
    m_grid->addWidget(m_edges, 0, 2);
    m_grid->addWidget(m_difference, 0, 3);
    m_grid->addWidget(m_state, 0, 4);
    m_grid->addWidget(m_close, 0, 5);
    m_grid->setColumnStretch(4, 1);
}

/// In narrow plots, what is for edges is below, and has no room for their distance.
void RunBar::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    const bool isWide = width() >= leastWideRunBar;
    showControls();
    if (isWide == m_isWide)
        return;
    m_isWide = isWide;
    m_grid->removeWidget(m_edges);
    if (isWide)
        m_grid->addWidget(m_edges, 0, 2);
    else
        m_grid->addWidget(m_edges, 1, 0, 1, 6);
}

/// All plants but that of the curves.
void RunBar::fillPlants()
{
    m_menu->clear();
    QStringList plants = m_context->plants();
    for (const QString &plant : qAsConst(m_settings.plants)) {
        if (!plants.contains(plant))
            plants << plant;
    }
    plants.removeAll(m_reference);
    for (const QString &plant : qAsConst(plants)) {
        QAction *action = m_menu->addAction(plant);
        action->setCheckable(true);
        action->setChecked(m_settings.plants.contains(plant));
        connect(action, &QAction::triggered, this, [this, plant](bool isChosen) { choosePlant(plant, isChosen); });
    }
    if (plants.isEmpty())
        m_menu->addAction(tr("There is no other run: open a recording (Ctrl+R)"))->setEnabled(false);
}

/// Those that are there now, and the chosen one.
void RunBar::fillEvents()
{
    QStringList texts = PlotRuns::eventTexts(*m_context, m_reference);
    if (!m_settings.event.isEmpty() && !texts.contains(m_settings.event))
        texts.prepend(m_settings.event);
    const QSignalBlocker blocker(m_event);
    m_event->clear();
    m_event->addItems(texts);
    m_event->setCurrentIndex(texts.indexOf(m_settings.event));
}

/// What belongs to the alignment and has room.
void RunBar::showControls()
{
    const bool hasEdges = m_settings.alignment == RunSettings::RisingEdges;
    for (QWidget *control : std::initializer_list<QWidget *>{m_signal, m_to, m_level})
        control->setVisible(hasEdges);
    for (QWidget *control : std::initializer_list<QWidget *>{m_apartLabel, m_apart})
        control->setVisible(hasEdges && width() >= leastBarWithAll);
    m_event->setVisible(m_settings.alignment == RunSettings::Events);
}

/// Before the list opens.
bool RunBar::eventFilter(QObject *object, QEvent *event)
{
    if (object == m_event && (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::FocusIn))
        fillEvents();
    return QWidget::eventFilter(object, event);
}

void RunBar::choosePlant(const QString &plant, bool isChosen)
{
    m_settings.plants.removeAll(plant);
    if (isChosen)
        m_settings.plants << plant;
    Q_EMIT edited();
}

template<typename Number>
void RunBar::edit(Number RunSettings::*member, Number value)
{
    if (m_isFilling || m_settings.*member == value)
        return;
    m_settings.*member = value;
    Q_EMIT edited();
}

void RunBar::showSettings(const RunSettings &settings, const QStringList &expressions)
{
    m_isFilling = true;
    m_settings = settings;
    const QSignalBlocker blocker(m_signal);
    m_signal->clear();
    m_signal->addItems(expressions);
    if (!settings.signal.isEmpty() && !expressions.contains(settings.signal))
        m_signal->addItem(settings.signal);
    m_signal->setCurrentText(settings.signal);
    m_alignment->setCurrentIndex(settings.alignment);
    m_level->setValue(settings.level);
    m_last->setValue(settings.last);
    m_apart->setValue(settings.apart);
    m_difference->setChecked(settings.isDifference);
    m_edges->setVisible(settings.alignment >= RunSettings::RisingEdges);
    fillEvents();
    showControls();
    m_plants->setText(settings.plants.isEmpty()         ? tr("This run")
                          : settings.plants.size() == 1 ? tr("Over it: %1").arg(settings.plants.first())
                                                        : tr("Over it: %1 runs").arg(settings.plants.size()));
    m_isFilling = false;
}

void RunBar::showUnit(const QString &unit)
{
    m_level->setSuffix(unit.isEmpty() ? QString() : QLatin1Char(' ') + unit);
}

void RunBar::showState(const QString &text, bool isProblem, const QString &reference)
{
    m_reference = reference;
    const QPlcTheme theme = m_context->theme();
    const QColor color = isProblem ? theme.warning : theme.mutedText;
    m_state->setText(QStringLiteral("<span style='color:%1'>%2</span>").arg(color.name(), text.toHtmlEscaped()));
    m_state->setToolTip(text);
}

}  // namespace qplc
