// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RunSettings.h"

#include <QtWidgets/QWidget>

class QComboBox;
class QGridLayout;
class QLabel;
class QMenu;
class QSpinBox;
class QToolButton;
class QPlcPanelContext;

namespace qplc {

class NumberBox;

/// The strip above a plot in which a person chooses which runs lie over each other, and how they
/// are aligned.
///
/// ```cpp
/// m_runBar->showSettings(settings, names of the curves, plant of the curves);
/// m_runBar->showState(tr("10 runs"));
/// connect(m_runBar, &RunBar::edited, this, [this] { take(m_runBar->settings()); });
/// ```
class RunBar : public QWidget
{
    Q_OBJECT
public:
    /// \param context  of the panel; outlives the bar
    explicit RunBar(QPlcPanelContext *context, QWidget *parent = nullptr);

    const RunSettings &settings() const { return m_settings; }
    /// \param expressions  whose edges can be chosen; what is chosen stays
    void showSettings(const RunSettings &settings, const QStringList &expressions);
    /// \param unit  of the level
    void showUnit(const QString &unit);
    /// \param reference  the plant that the others lie over
    void showState(const QString &text, bool isProblem, const QString &reference);

Q_SIGNALS:
    /// A person has changed the settings.
    void edited();

protected:
    void resizeEvent(QResizeEvent *event) override;
    bool eventFilter(QObject *object, QEvent *event) override;

private:
    void makeControls();
    void arrange();
    void fillPlants();
    void fillEvents();
    void showControls();
    template<typename Number>
    void edit(Number RunSettings::*member, Number value);
    void choosePlant(const QString &plant, bool isChosen);

    QPlcPanelContext *m_context;
    RunSettings m_settings;
    QString m_reference;
    bool m_isFilling = false;  // controls follow settings, not the other way round
    QToolButton *m_plants = nullptr;
    QMenu *m_menu = nullptr;
    QComboBox *m_alignment = nullptr;
    QWidget *m_edges = nullptr;  // what is for edges
    QComboBox *m_event = nullptr;
    QLabel *m_to = nullptr;
    QComboBox *m_signal = nullptr;
    NumberBox *m_level = nullptr;
    QSpinBox *m_last = nullptr;
    QLabel *m_apartLabel = nullptr;
    NumberBox *m_apart = nullptr;
    QToolButton *m_difference = nullptr;
    QLabel *m_state = nullptr;
    QToolButton *m_close = nullptr;
    QGridLayout *m_grid = nullptr;
    bool m_isWide = true;
};

}  // namespace qplc
