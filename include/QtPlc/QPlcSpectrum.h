// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with the frequencies in signals: the vibration of a tether, the rhythm of a controller,
/// the noise of a sensor.
///
/// \code
/// QPlcSpectrum spectrum;
/// spectrum.addSignals({"tetherForce", "= derivative(tetherLength)"});
/// spectrum.setView(QPlcSpectrum::Density);
/// \endcode
///
/// The spectrum is that of the values between the cursors A and B of the window, or without both
/// cursors of the time that the plots show. In a live window it is computed again, at most once a
/// second.
///
/// A spectrum needs evenly spaced values. If values are missing, are substitutes (qualities Safe
/// and Invalid), or change their distance in time, the panel takes the longest piece without such
/// places, and says so. It takes the newest 1 048 576 cycles at most, and shows the first 8
/// signals.
///
/// | | mouse | keys |
/// |---|---|---|
/// | amplitudes, power density, spectrogram | context menu | `1`, `2`, `3` |
/// | logarithmic frequency, logarithmic values | context menu | `F`, `Y` |
/// | the next signal, of which there is one spectrogram | context menu | `V` |
/// | values near the mouse, in the line below | move | |
/// | cursor: place it, at the highest line, remove it | click | `P`; `0` |
/// | move the cursor by a line | context menu | `Ctrl+Left`, `Ctrl+Right` |
/// | zoom, at the mouse | wheel, two fingers; over an axis or with Ctrl only one axis | `+`, `-` |
/// | pan | drag; over an axis only this one | arrow keys |
/// | zoom into a box | drag with Shift or the right button | |
/// | show everything | double click | `A` |
/// | export the visible part as CSV | context menu | `Ctrl+E` |
/// | copy the visible part as a table | context menu | `Ctrl+C` |
/// | export it as PNG, SVG or PDF | context menu | `Ctrl+Shift+E` |
/// | copy it as a picture | context menu | `Ctrl+Shift+C` |
///
/// Settings; all of them may be missing:
/// \code{.json}
/// {
///     "signals": ["tetherForce", "= derivative(tetherLength)"],
///     "show": "density",
///     "window": "hann",
///     "segment": 1024,
///     "overlap": 50,
///     "logFrequency": false,
///     "logValues": true
/// }
/// \endcode
/// `show` is `amplitude` (default), `density` or `spectrogram`; `window` is `hann` (default),
/// `flatTop` or `rectangular`. `segment` is the number of values of a segment of densities and
/// spectrograms, 16 to 65536 (default 0: automatic), `overlap` that of two segments [%], 0 to 90.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcSpectrum : public QPlcWidget
{
    Q_OBJECT
public:
    /// What is shown.
    enum View {
        Amplitude,   ///< a sine of the amplitude a has the height a at its frequency [unit]
        Density,     ///< one-sided power spectral density, by Welch's method [unit^2/Hz]
        Spectrogram  ///< density over time and frequency, of one signal
    };
    Q_ENUM(View)

    /// Returns "Spectrum", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Spectrum"); }

    /// Makes a panel without signals.
    explicit QPlcSpectrum(QWidget *parent = nullptr);
    ~QPlcSpectrum() override;
    QString kind() const override { return typeName(); }

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    bool addSignals(const QStringList &references) override;

    /// Returns what is shown.
    View view() const;
    /// Sets what is shown; default Amplitude. Emits no settingsEdited().
    void setView(View view);

private:
    class Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};

/// The factory of this panel.
///
/// \ingroup panels
using QPlcSpectrumFactory = QPlcWidgetFactoryOf<QPlcSpectrum>;
