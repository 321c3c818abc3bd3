// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventFiles.h"
#include "QPlcPast.h"
#include "gui/plot/Trigger.h"

#include <QtWidgets/QWidget>

#include <deque>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QHBoxLayout;
class QLabel;
class QToolButton;
class QPlcPanelContext;
class QPlcTimeAxis;

namespace qplc {

class EventFileEditor;
class NumberBox;

/// The strip above a plot in which a person chooses signal, kind, level and mode of a trigger, and
/// sees whether it is armed, how often it was met, and has it armed again.
///
/// It has the trigger, feeds it with what comes, and moves a time axis: that of the plot, or, when
/// a person wants that, that of the window. A plot shows it when a person wants a trigger, and
/// keeps its settings:
///
/// ```cpp
/// m_triggerBar = new TriggerBar(context(), this); // above the canvas; hidden: the trigger rests
/// m_triggerBar->setOwnTime(&m_ownTime);           // without: always the time of the window
/// m_triggerBar->setSignals(names of the curves);  // whenever they change; what is chosen stays
/// m_triggerBar->applySettings(settings.value("trigger").toObject());
/// connect(m_triggerBar, &TriggerBar::settingsEdited, this, &QPlcTimePlot::settingsEdited);
/// // To draw a mark at bar->trigger().shownEvent() and a line at its level:
/// connect(m_triggerBar, &TriggerBar::triggered, this, ...);
/// ```
///
/// It works while it is shown, also on a tab that is not seen: what a single event has brought is
/// still there when somebody comes back. While it is not FreeRunning, QPlcTimeAxis::show() is
/// called for each new event with [event - pre, event + post], post being what the span of the view
/// leaves; Auto goes back to live when no event comes. A person who pans meanwhile keeps what he
/// sees until the next event.
class TriggerBar : public QWidget
{
    Q_OBJECT
public:
    /// \param context  of the panel; outlives the bar
    explicit TriggerBar(QPlcPanelContext *context, QWidget *parent = nullptr);
    ~TriggerBar() override;

    /// What settings() may have.
    static QStringList keys();
    /// The time axis that is moved unless isLinked(); outlives the bar.
    void setOwnTime(QPlcTimeAxis *time) { m_ownTime = time; }
    /// Whether events are shown in all plots of the window.
    bool isLinked() const { return m_isLinked; }
    /// Whether it shows an event, and nobody has moved the view meanwhile.
    bool showsEvent() const;
    void setVisible(bool isVisible) override;
    /// What can be chosen: expressions as QPlcPanelContext::past() takes them.
    void setSignals(const QStringList &expressions);
    /// Whether and where events are saved; who saves them tells it by showSaved().
    const EventFileSettings &fileSettings() const;
    void showSaved(int files);
    /// "signal", "linked", "save", and what Trigger::Settings::toJson() gives; defaults are left
    /// out.
    QJsonObject settings() const;
    void applySettings(const QJsonObject &settings);
    const Trigger &trigger() const { return m_trigger; }

public Q_SLOTS:
    /// Forgets what was, and waits for the next event.
    void arm();

Q_SIGNALS:
    /// A person has changed the settings.
    void settingsEdited();
    /// State, count or shown event are others.
    void triggered();
    /// All that is shown around an event has come, while events are to be saved. \param begin, end
    /// of what is shown [ns]
    void eventCame(qint64 event, qint64 begin, qint64 end);
    /// What is saved begins anew: armed, or other settings.
    void savingBegins();

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void makeControls();
    void arrange();
    void fillMenu();
    void placeControls(bool isWide);
    void link(bool isLinked);
    void release();
    void showUpperLevel();
    QPlcTimeAxis *time() const;
    NumberBox *addNumber(const QString &name, double minimum, double Trigger::Settings::*number, double shown = 1.0);
    void findSource();
    template<typename Number>
    void edit(Number Trigger::Settings::*member, Number value);
    void chooseSignal();
    void chooseLink(bool isLinked);
    void begin();
    void showSettings();
    void takeValues();
    void showEventView();
    void tellCompleteEvents();
    void showState();
    bool hasWindow() const;

    QPlcPanelContext *m_context;
    QPlcTimeAxis *m_ownTime = nullptr;
    bool m_isLinked = false;
    bool m_hasFrozen = false;  // the time axis, for an event
    bool m_isWide = true;      // all controls are in the row
    QPlcPast m_source;
    Trigger m_trigger;
    QString m_wanted;  // signal
    std::optional<Trigger::Time> m_seenEvent;
    struct Awaited
    {
        Trigger::Time event;
        Trigger::View view;
    };
    std::deque<Awaited> m_awaited;  // events of which not all has come
    int m_saved = 0;
    bool m_isFilling = false;  // controls follow settings, not the other way round
    QComboBox *m_signal = nullptr;
    QComboBox *m_kind = nullptr;
    NumberBox *m_level = nullptr;
    NumberBox *m_upperLevel = nullptr;
    NumberBox *m_hysteresis = nullptr;
    NumberBox *m_preShare = nullptr;  // [%]
    NumberBox *m_holdOff = nullptr;
    QComboBox *m_mode = nullptr;
    QCheckBox *m_linked = nullptr;
    EventFileEditor *m_files = nullptr;
    QHBoxLayout *m_row = nullptr;
    QFormLayout *m_form = nullptr;
    QToolButton *m_more = nullptr;
    QToolButton *m_arm = nullptr;
    QLabel *m_state = nullptr;
    QLabel *m_count = nullptr;
};

}  // namespace qplc
