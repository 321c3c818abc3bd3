// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotSettings.h"
#include "QPlcTheme.h"
#include "gui/panel/SettingsEditor.h"

class QCheckBox;
class QGridLayout;
class QLineEdit;
class QPlcPanelContext;
class QToolButton;

namespace qplc {

/// The settings of a time plot, to be changed by a person. Each change is told at once.
class PlotSettingsEditor : public SettingsEditor
{
    Q_OBJECT
public:
    /// \param context of the panel, which outlives the editor \param furtherUnits of axes besides
    ///         the first one at the left and at the right
    PlotSettingsEditor(const PlotSettings &settings, const QStringList &furtherUnits, QPlcPanelContext *context,
                       QWidget *parent = nullptr);

    const PlotSettings &settings() const { return m_settings; }

Q_SIGNALS:
    void edited(const qplc::PlotSettings &settings);

private:
    void makeCurves();
    void addLine(int place);
    QToolButton *makeColorButton(int place);
    void paintColor(QToolButton *button, int place) const;
    QLineEdit *makeScale(const QString &name, double PlotCurveSettings::*member, int place);
    /// An axis of the settings.
    struct Range
    {
        int axis;
        QString unit;
    };
    QWidget *makeOptions(const QStringList &furtherUnits);
    QLineEdit *makeEnd(const QString &name, const Range &range, std::optional<double> PlotRangeSettings::*end);
    QLineEdit *makeLines(const QString &name, const Range &range);
    PlotRangeSettings &settingsOf(const Range &range) { return m_settings.range(range.axis, range.unit); }
    QCheckBox *makeCheck(const QString &text, bool PlotSettings::*member);
    QCheckBox *makeLimits();
    QWidget *makeTimeAxis();
    void removeCurve(int place);
    void tell();

    PlotSettings m_settings;
    QPlcTheme m_theme;
    QWidget *m_curves = nullptr;
    QCheckBox *m_limits = nullptr;
    QGridLayout *m_grid = nullptr;
};

}  // namespace qplc
