// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with one signal, or a formula of signals, as an instrument: a dial, a bar, a large
/// number, or an LED.
///
/// \code
/// QPlcGauge gauge;
/// gauge.applySettings({{"signal", "tetherForce"}, {"style", "bar"}, {"alarmHigh", 4500}});
/// \endcode
///
/// Settings:
/// - `signal`: "tetherForce", "bodyPosition_earth[2]", "plant/tetherForce", or in a window a
///   formula: "= norm(bodyVelocity_earth)". A signal with three elements is shown as three numbers.
/// - `style`: "dial" (default), "bar" (horizontal or vertical, as space permits), "number", "led".
/// - `minimum`, `maximum`: ends of the scale [unit of the signal]. Default: limits of the signal
///   table; without those the scale grows with the values.
/// - `alarmLow`, `warningLow`, `warningHigh`, `alarmHigh`: limits at which a value is a warning or
///   an alarm, shown by colour, sign and words. Default: none.
/// - `hysteresis`: how far a value has to come back before a warning or alarm ends. Default: 1 % of
///   the scale.
/// - `extremes`: true shows the smallest and largest value since reset. Default: false.
///
/// A value outside of the limits of the signal table is an alarm without further settings. Stale
/// values are grey, with their age. If a person looks at the past, the gauge shows the value of
/// that time. A signal that does not exist is a grey line that says so, until it does.
///
/// Outside of a window realTimeout() brings the values; the signal comes from the table of the
/// process (QPlcSignalIndexTable), and inputSignalIndices() has it.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcGauge : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Gauge", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Gauge"); }

    /// Makes a gauge without a signal.
    explicit QPlcGauge(QWidget *parent = nullptr);
    ~QPlcGauge() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Shows the first signal of \a references instead of the present one.
    bool addSignals(const QStringList &references) override;
    QSize sizeHint() const override;

public Q_SLOTS:
    void realTimeout(const QList<QPlcSignalList> &signalValues) override;

protected:
    void contextChanged() override;
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    Q_DECL_HIDDEN void addStyleAction(const QString &text, const QString &style);
    Q_DECL_HIDDEN void showSettings();
    Q_DECL_HIDDEN void takeEdit();

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcGaugeFactory = QPlcWidgetFactoryOf<QPlcGauge>;
