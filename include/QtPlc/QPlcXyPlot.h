// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with signals over signals: the flight path of a kite, a power curve, a phase portrait.
///
/// \code
/// QPlcXyPlot plot;
/// plot.addSignals({"kite.azimuth", "kite.elevation"});  // x, y
/// plot.setAspectEqual(true);
/// \endcode
///
/// It shows the same span of time as all plots of the window. A dot marks the newest values, or in
/// a frozen view those at the pointer; a dot of stale values is grey and says so.
///
/// | | mouse | keys |
/// |---|---|---|
/// | zoom, at the mouse | wheel, two fingers; over an axis or with Ctrl only one axis | `+`, `-` |
/// | pan | drag; over an axis only its values | arrow keys |
/// | zoom into a box | drag with Shift or the right button | |
/// | show everything, automatic axes | double click | `A` |
/// | equal units on both axes | context menu | `E` |
/// | export the visible part as CSV | context menu | `Ctrl+E` |
/// | copy the visible part as a table | context menu | `Ctrl+C` |
/// | export it as PNG, SVG or PDF | context menu | `Ctrl+Shift+E` |
/// | copy it as a picture | context menu | `Ctrl+Shift+C` |
///
/// Zoom is a view and not a setting; a new curve ends it.
///
/// Settings; `color` and `equalAspect` (default false) may be missing. x and y of a curve belong to
/// the same plant:
/// \code{.json}
/// {
///     "curves": [{"x": "kite.azimuth", "y": "= mean(kite.elevation, 5)", "color": "#d55e00"}],
///     "equalAspect": true
/// }
/// \endcode
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcXyPlot : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "XY plot", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("XY plot"); }

    /// Makes a plot without curves.
    explicit QPlcXyPlot(QWidget *parent = nullptr);
    ~QPlcXyPlot() override;
    QString kind() const override { return typeName(); }

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Adds a curve for each two signals; the first one is its x. A single one that is left waits
    /// for the next call.
    bool addSignals(const QStringList &references) override;

    /// Returns true if a unit has the same length on both axes, so that circles are round.
    bool isAspectEqual() const;
    /// Sets whether a unit has the same length on both axes; default false. Emits no
    /// settingsEdited().
    void setAspectEqual(bool isEqual);

private:
    class Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcXyPlotFactory = QPlcWidgetFactoryOf<QPlcXyPlot>;
