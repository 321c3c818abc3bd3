// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel that shows how punctual a plant is: histograms of lateness, execution and round trip of
/// the master, and of execution and round trip of its nodes.
///
/// \code
/// QPlcJitterHistogram histogram;
/// const QJsonArray shown{"Master.lateness", "Kite.roundTrip"};
/// histogram.applySettings({{"show", shown}, {"window", "last10s"}});
/// \endcode
///
/// Counts and durations have logarithmic axes; lines mark the median (p50), the 99th percentile and
/// the largest value. The panel asks the master once a second, only while it is visible. `qtplc
/// jitter --hist` shows the same on a terminal.
///
/// Keys: `T` the last 10 s; `L`, `X` and `R` lateness, execution and round trip of the master;
/// `Ctrl+Shift+E` and `Ctrl+Shift+C` a picture (PNG, SVG, PDF) to a file or to the clipboard.
///
/// Settings:
/// - `plant`: name of a plant; default the first one. With several plants the caption names it.
/// - `show`: list of "Master.lateness", "Kite.roundTrip" and the like; default the lateness of the
///   master.
/// - `window`: "sinceStart" (default) or "last10s".
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcJitterHistogram : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Jitter histogram", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Jitter histogram"); }

    /// Makes a panel; it has no figures outside of a window.
    explicit QPlcJitterHistogram(QWidget *parent = nullptr);
    ~QPlcJitterHistogram() override;
    QString kind() const override { return typeName(); }

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;

private:
    class Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcJitterHistogramFactory = QPlcWidgetFactoryOf<QPlcJitterHistogram>;
