// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with signals over signals: the flight path of a kite, a power curve, a phase portrait.
///
/// It shows the piece of time that all plots of the window show, and the values at the moment that is looked at (now, or where the pointer of a frozen view is) as a dot; a dot of values that are no
/// longer true is grey, and says so. Curves have few points in all: those that can be seen.
///
/// | | mouse | keys |
/// |---|---|---|
/// | zoom, about the mouse | wheel, two fingers; over an axis, or with Ctrl, only one | `+`, `-` |
/// | pan | drag; over an axis only its values | arrow keys |
/// | zoom into a box | drag with Shift or the right button | |
/// | everything, axes automatic again | double click | `A` |
/// | equal units on both axes | context menu | `E` |
/// | export what is seen | context menu | `Ctrl+E` CSV, `Ctrl+C` table into the clipboard, `Ctrl+Shift+E` PNG, SVG or PDF, `Ctrl+Shift+C` picture into the clipboard |
///
/// Zoom is a view, and no settings; a new curve ends it.
///
/// Settings: `{"curves": [{"x": "kite.azimuth", "y": "= mean(kite.elevation, 5)", "color": "#rrggbb"}], "equalAspect": true}`; colour and aspect may be missing. x and y of a curve are of one plant.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcXyPlot : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("XY plot"); }

    explicit QPlcXyPlot(QWidget *parent = nullptr);
    ~QPlcXyPlot() override;
    QString kind() const override { return typeName(); }

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Two signals are a curve, the first one its x. One that is left waits for the next.
    bool addSignals(const QStringList &references) override;

    /// Whether a unit is as long on the one axis as on the other: circles are round.
    bool isAspectEqual() const;
    void setAspectEqual(bool isEqual);

private:
    class Private;
    std::unique_ptr<Private> d;
};

using QPlcXyPlotFactory = QPlcWidgetFactoryOf<QPlcXyPlot>;
