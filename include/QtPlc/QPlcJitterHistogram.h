// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel that shows how punctual a plant is: histograms of lateness, execution and round trip of the master, and of execution and round trip of its nodes.
///
/// Counts and durations are logarithmic; lines tell the median (p50), the 99th percentile and the largest value. It asks the master once a second, and only while it is seen. `qtplc jitter --hist` says
/// the same on a terminal.
///
/// Keys: `T` the last 10 s, `L`, `X` and `R` lateness, execution and round trip of the master, `Ctrl+Shift+E` and `Ctrl+Shift+C` a picture (PNG, SVG, PDF) into a file or the clipboard.
///
/// Settings: `{"plant": "tower", "show": ["Master.lateness", "Kite.roundTrip"], "window": "last10s"}`. Without plant: the first one (with several, the caption says whose figures these are); without show: the lateness of the master; window is "sinceStart"
/// or "last10s", since the start if it is missing.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcJitterHistogram : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Jitter histogram"); }

    explicit QPlcJitterHistogram(QWidget *parent = nullptr);
    ~QPlcJitterHistogram() override;
    QString kind() const override { return typeName(); }

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;

private:
    class Private;
    std::unique_ptr<Private> d;
};

using QPlcJitterHistogramFactory = QPlcWidgetFactoryOf<QPlcJitterHistogram>;
