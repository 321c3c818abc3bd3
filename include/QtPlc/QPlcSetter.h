// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel that sets one signal by hand, and shows its actual value beside.
///
/// \code
/// QPlcSetter setter;
/// setter.applySettings({{"signal", "winch.speed"}, {"style", "slider"}, {"maximum", 5}});
/// \endcode
///
/// Styles:
/// - `number`: typed; sent once by Enter or *Set*, never during typing. Esc discards the input. Up,
///   Down, Page up and Page down step by 1 % and 10 % of the range.
/// - `slider`: sent while it is dragged, at most 20 times a second, and always at the end.
/// - `toggle`: on (`on`, default 1) or off (neutral).
/// - `momentary`: `pressed` (default the maximum) while the button is held; then neutral.
/// - `knob`: turned; sent once when the mouse button is released, or by Enter after keys or the
///   wheel. Esc discards the input.
/// - `list`: one of the names that the values of the signal have in the signal table (`values`);
///   sent once, as its number.
/// - `generator`: steps, ramps or a sine, with a new value every 20 ms.
///
/// A value outside of the limits of the signal table becomes the limit, and the setter says so. For
/// a signal that a node writes, people first take a lease (*Take control*, Ctrl+T) and later
/// release it (*Give back*, Ctrl+B). A held signal has a frame in every window. *Neutral* is `safe`
/// of the signal table, else 0, else the limit closest to 0. Momentary and generator set it when
/// they end: also when the panel is hidden, and with a master that supports leases, when this
/// window, its computer or the network is lost.
///
/// Settings: `signal` (a reference), `style`, `minimum` and `maximum` within those of the signal
/// table, and `on`, `pressed`, `generator` as above. applySettings() writes no signal.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcSetter : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Setter", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Setter"); }

    /// Makes a setter without a signal.
    explicit QPlcSetter(QWidget *parent = nullptr);
    ~QPlcSetter() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Sets the first valid signal of \a references from now on, with its limits from the signal
    /// table.
    bool addSignals(const QStringList &references) override;

protected:
    void contextChanged() override;
    void paintEvent(QPaintEvent *event) override;
    void showEvent(QShowEvent *event) override;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcSetterFactory = QPlcWidgetFactoryOf<QPlcSetter>;
