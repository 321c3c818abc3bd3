// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel that sets signals with keys or with the axes of a gamepad. While a key is held, its
/// signal has a value; otherwise it is neutral (`safe` of the signal table, else 0, else the limit
/// closest to 0).
///
/// \code
/// QPlcKeyboardControl control;
/// const QJsonObject left{{"key", "Left"}, {"signal", "bodyControlYawSpeed"}, {"value", -40}};
/// control.applySettings({{"keys", QJsonArray{left}}});
/// \endcode
///
/// *Take control* (Ctrl+T) takes leases of all signals at once, *Give back* (Ctrl+B) releases them;
/// the panel shows in large letters who has control. Keys work while the panel has the keyboard
/// focus. They work like a dead man's switch: when a key is released, the focus or the window is
/// lost, or the panel is hidden, the signal is neutral at once. When this window, its computer or
/// the network is lost, the master sets neutral and keeps it until a person takes or releases the
/// lease.
///
/// Axes work while they are armed, by the button of the panel or the lower button of the gamepad.
/// What releases keys disarms them.
///
/// Settings:
/// \code{.json}
/// {
///     "keys": [{"key": "Left", "signal": "bodyControlYawSpeed", "value": -40}],
///     "axes": [{"axis": "LeftX", "signal": "bodyControlYawSpeed", "value": 90,
///               "deadZone": 0.1, "expo": 0.3}]
/// }
/// \endcode
/// Keys have the names of QKeySequence. Axes are `LeftX`, `LeftY`, `RightX` and `RightY`, positive
/// to the right and upwards. `value` is in the unit of the signal, for an axis at its end.
/// `deadZone` (share of the way) and `expo` (0 linear to 1 cubic) may be missing.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcKeyboardControl : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Keyboard control", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Keyboard control"); }

    /// Makes a panel without keys and axes.
    explicit QPlcKeyboardControl(QWidget *parent = nullptr);
    /// Sets the signals to neutral.
    ~QPlcKeyboardControl() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;

protected:
    void contextChanged() override;
    bool event(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void keyReleaseEvent(QKeyEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcKeyboardControlFactory = QPlcWidgetFactoryOf<QPlcKeyboardControl>;
