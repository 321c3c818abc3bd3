// SPDX-License-Identifier: Apache-2.0
#include "QPlcSpectrum.h"

#include "ChartLook.h"
#include "ChartPanel.h"
#include "QPlcTimeAxis.h"
#include "SpectrumCanvas.h"
#include "SpectrumEditor.h"
#include "XyInteraction.h"
#include "gui/panel/PanelSettings.h"
#include "gui/plot/SpectrumJob.h"

#include <QtCore/QDateTime>
#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonArray>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>

using namespace qplc;

namespace {

constexpr int mostSpectra = 8;   // of a panel
constexpr int livePause = 1000;  // [ms] between spectra of new values
constexpr int costOfPause = 4;   // computing takes at most so small a share of the time
constexpr int tickPause = 500;   // [ms]

constexpr const char *spectrumSignalsKey = "signals";
constexpr const char *spectrumViewKey = "show";
constexpr const char *spectrumWindowKey = "window";
constexpr const char *spectrumSegmentKey = "segment";
constexpr const char *spectrumOverlapKey = "overlap";
constexpr const char *logFrequencyKey = "logFrequency";
constexpr const char *logValuesKey = "logValues";

const QJsonObject defaults{{spectrumSignalsKey, QJsonArray()},
                           {spectrumViewKey, QStringLiteral("amplitude")},
                           {spectrumWindowKey, QStringLiteral("hann")},
                           {spectrumSegmentKey, 0},
                           {spectrumOverlapKey, 50},
                           {logFrequencyKey, false},
                           {logValuesKey, true}};

const QStringList &views()
{
    static const QStringList names{QStringLiteral("amplitude"), QStringLiteral("density"),
                                   QStringLiteral("spectrogram")};
    return names;
}

QString frequencyText(double frequency)
{
    return QPlcPanelContext::text(frequency, QStringLiteral("Hz"));
}

}  // namespace

class QPlcSpectrum::Private : public ChartPanel
{
public:
    /// Where the values of a spectrum are in the store, so that new ones are noticed.
    struct Extent
    {
        QPlcPast::Row begin;
        QPlcPast::Row end;
        bool operator==(const Extent &other) const { return begin == other.begin && end == other.end; }
    };

    explicit Private(QPlcSpectrum *panel);

    QJsonValue setting(const char *key) const
    {
        const QJsonValue value = settings.value(key);
        return value.isUndefined() ? defaults.value(QLatin1String(key)) : value;
    }
    QStringList references() const { return setting(spectrumSignalsKey).toVariant().toStringList(); }
    void bind() override;
    void draw() override;
    void showTheme(const QPlcTheme &theme) override { canvas->setTheme(theme); }
    void resized() override { showTexts(); }
    void takePast() override
    {
        isOutdated = true;
        schedule();
    }
    QMenu *createMenu() override;

    void edit(const char *key, const QJsonValue &value);
    void showSettings();
    void makeActions();
    void connectInteraction();

    // -- computing --
    SpectrumJob::Wish wish() const;
    std::vector<QPlcPast> wanted() const;
    std::vector<Extent> extents(const SpectrumJob::Wish &of) const;
    bool isFollowing() const;
    void show(const std::vector<SpectrumJob::Result> &results);
    ChartExport::Table table() const;

    // -- texts --
    void showTexts();
    void showReadout();
    QString messageText() const;
    QString noteOf(const SpectrumJob::Result &result) const;
    QString noteText() const;
    QString readoutText() const;

    // -- the cursor --
    void placeAtHighest();
    void moveCursor(int lines);

    QPlcSpectrum *q;
    SpectrumCanvas *canvas;
    QLabel *message;  // what is missing
    QLabel *legend;
    QLabel *note;     // what the spectra are of
    QLabel *readout;  // at the mouse or the cursor
    XyInteraction *interaction;
    QAction *logFrequency = nullptr;
    QAction *logValues = nullptr;
    PanelSettings settings{spectrumSignalsKey, spectrumViewKey, spectrumWindowKey, spectrumSegmentKey,
                           spectrumOverlapKey, logFrequencyKey, logValuesKey};
    std::vector<QPlcPast> pasts;  // of the signals, those that are missing, too
    int selected = 0;             // signal of the spectrogram

    SpectrumJob job;
    SpectrumJob::Wish asked;           // last
    std::vector<QPlcPast> askedPasts;  // then
    std::vector<Extent> askedExtents;  // then
    bool isOutdated = true;            // whatever was asked last
    QElapsedTimer sinceAsked;
    qint64 cost = 0;  // [ms] of the last job
    std::vector<SpectrumJob::Result> results;
    SpectrumJob::Wish shown;  // what the results are of
    std::vector<QPlcPast> shownPasts;
};

QPlcSpectrum::Private::Private(QPlcSpectrum *panel)
    : ChartPanel(panel, [this] { return std::make_unique<ChartPicture>(canvas, legend->text()); })
    , q(panel)
    , canvas(new SpectrumCanvas)
    , message(new QLabel)
    , legend(new QLabel)
    , note(new QLabel)
    , readout(new QLabel)
    , interaction(new XyInteraction(canvas, canvas, panel))
{
    auto *all = new QVBoxLayout(panel);
    all->setContentsMargins(2, 2, 2, 2);
    all->setSpacing(0);
    for (QWidget *part : {static_cast<QWidget *>(message), static_cast<QWidget *>(legend), static_cast<QWidget *>(note),
                          static_cast<QWidget *>(canvas), static_cast<QWidget *>(readout)})
        all->addWidget(part, part == canvas ? 1 : 0);
    for (QLabel *label : {message, legend, note, readout}) {
        label->setWordWrap(true);
        label->setMargin(label == message ? 6 : 3);
        label->setTextFormat(label == legend ? Qt::RichText : Qt::PlainText);
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        if (label != message)
            label->setFont(scaleFont(label->font()));
    }
    readout->setAlignment(Qt::AlignRight);
    canvas->setAccessibleName(tr("Spectrum"));
    setTickPeriod(tickPause);
    setQuietTexts();
    makeActions();
    connectInteraction();
    connect(&job, &SpectrumJob::finished, canvas, [this] {
        cost = sinceAsked.elapsed();
        show(job.results());
        schedule();  // meanwhile something else may be wanted
    });
}

void QPlcSpectrum::Private::bind()
{
    pasts.clear();
    const QStringList all = references();
    QStringList titles;
    for (const QString &reference : all) {
        pasts.push_back(context()->past(reference));
        titles << QPlcPast::textOf(reference);
    }
    q->setDefaultTitle(titles.join(QStringLiteral(", ")));
    isOutdated = true;
    schedule();
}

// ---- computing ----

SpectrumJob::Wish QPlcSpectrum::Private::wish() const
{
    SpectrumJob::Wish wish;
    wish.kind = SpectrumJob::Kind(q->view());
    const QString window = setting(spectrumWindowKey).toString();
    wish.window = window == QLatin1String("flatTop") ? Spectrum::FlatTop
        : window == QLatin1String("rectangular")     ? Spectrum::Rectangular
                                                     : Spectrum::Hann;
    const int segment = setting(spectrumSegmentKey).toInt();
    constexpr int longest = 65536;
    if (segment > 0)
        wish.segments.length = std::size_t(std::clamp(segment, int(Spectrum::LeastSamples), longest));
    wish.segments.overlap = setting(spectrumOverlapKey).toDouble() / 100.0;
    const auto a = context()->cursor(QPlcPanelContext::CursorA);
    const auto b = context()->cursor(QPlcPanelContext::CursorB);
    wish.begin = a && b ? std::min(*a, *b) : context()->begin();
    wish.end = a && b ? std::max(*a, *b) : context()->end();
    return wish;
}

/// Those that are shown.
std::vector<QPlcPast> QPlcSpectrum::Private::wanted() const
{
    if (q->view() != Spectrogram)
        return {pasts.begin(), pasts.begin() + std::min<std::ptrdiff_t>(mostSpectra, std::ptrdiff_t(pasts.size()))};
    return pasts.empty() ? std::vector<QPlcPast>() : std::vector<QPlcPast>{pasts[std::size_t(selected) % pasts.size()]};
}

std::vector<QPlcSpectrum::Private::Extent> QPlcSpectrum::Private::extents(const SpectrumJob::Wish &of) const
{
    std::vector<Extent> all;
    for (const QPlcPast &past : wanted())
        all.push_back(past ? Extent{past.rowAt(of.begin), past.rowAt(of.end + 1)} : Extent{0, 0});
    return all;
}

/// The time moves on by itself.
bool QPlcSpectrum::Private::isFollowing() const
{
    return context()->isLive()
        && !(context()->cursor(QPlcPanelContext::CursorA) && context()->cursor(QPlcPanelContext::CursorB));
}

/// Asks for new spectra where those of now are others, and not too often.
void QPlcSpectrum::Private::draw()
{
    showReadout();
    const SpectrumJob::Wish now = wish();
    const std::vector<Extent> nowExtents = extents(now);
    if (!isOutdated && now == asked && nowExtents == askedExtents)
        return;
    const qint64 pause = std::max<qint64>(isFollowing() ? livePause : 0, costOfPause * cost);
    const bool isEarly = sinceAsked.isValid() && sinceAsked.elapsed() < pause;
    if (!isOutdated && (job.isBusy() || isEarly))
        return;  // ticks come back to it
    isOutdated = false;
    asked = now;
    askedPasts = wanted();
    askedExtents = nowExtents;
    sinceAsked.start();
    job.begin(askedPasts, now);
}

void QPlcSpectrum::Private::show(const std::vector<SpectrumJob::Result> &computed)
{
    results = computed;
    shown = asked;
    shownPasts = askedPasts;
    const auto isShown = [this](std::size_t i) { return i < shownPasts.size() && results[i].problem.isEmpty(); };
    if (shown.kind == SpectrumJob::Picture) {
        SpectrumCanvas::Spectrogram picture;
        if (!results.empty() && isShown(0))
            picture = {shownPasts[0].text(), shownPasts[0].unit, results[0].picture};
        canvas->show(picture);
    } else {
        QVector<SpectrumCanvas::Curve> curves;
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (isShown(i))
                curves.append({shownPasts[i].text(), shownPasts[i].unit, context()->theme().curve(int(i)),
                               results[i].lines, shown.kind == SpectrumJob::Density});
        }
        canvas->show(curves);
    }
    showTexts();
}

/// What is seen at the moment of the wish.
ChartExport::Table QPlcSpectrum::Private::table() const
{
    const SeenRange frequencies = canvas->seenFrequencies();
    if (canvas->isSpectrogram()) {
        SpectrogramTable::Source source;
        if (!results.empty() && results.front().problem.isEmpty() && !shownPasts.empty())
            source = {shownPasts.front().text(), SpectrumCanvas::densityUnit(shownPasts.front().unit),
                      results.front().begin, results.front().picture};
        return [source, frequencies, times = canvas->seenTimes()](TableText::Format format) {
            return std::make_shared<SpectrogramTable>(format, source, times, frequencies);
        };
    }
    std::vector<SpectrumTable::Column> columns;
    for (const SpectrumCanvas::Curve &curve : canvas->curves())
        columns.push_back(
            {curve.title, curve.isDensity ? SpectrumCanvas::densityUnit(curve.unit) : curve.unit, curve.lines});
    return [columns, frequencies](TableText::Format format) {
        return std::make_shared<SpectrumTable>(format, columns, frequencies);
    };
}

// ---- texts ----

void QPlcSpectrum::Private::showTexts()
{
    const QString missing = messageText();
    const bool hasPicture = std::any_of(results.begin(), results.end(),
                                        [](const SpectrumJob::Result &result) { return result.problem.isEmpty(); });
    const bool isTold = hasPicture && q->height() >= leastHeightOfTexts;
    message->setText(missing);
    message->setVisible(!missing.isEmpty());
    message->setAlignment(hasPicture ? Qt::AlignLeft : Qt::AlignCenter);
    message->setSizePolicy(QSizePolicy::Ignored, hasPicture ? QSizePolicy::Preferred : QSizePolicy::Expanding);
    canvas->setVisible(hasPicture);
    QVector<LegendEntry> entries;
    for (const SpectrumCanvas::Curve &curve : canvas->curves())
        entries.append({withUnit(curve.title, curve.unit), curve.color});
    legend->setText(legendText(entries));
    legend->setVisible(isTold && !legend->text().isEmpty());
    note->setText(noteText());
    note->setVisible(isTold && !note->text().isEmpty());
    showReadout();
}

QString QPlcSpectrum::Private::messageText() const
{
    if (pasts.empty())
        return tr("Drop signals here: their frequencies are shown.");
    QStringList problems;
    for (const SpectrumJob::Result &result : results) {
        if (!result.problem.isEmpty() && !problems.contains(result.problem))
            problems << result.problem;
    }
    if (int(pasts.size()) > mostSpectra && shown.kind != SpectrumJob::Picture)
        problems << tr("Only the first %1 signals are shown.").arg(mostSpectra);
    return problems.join(QLatin1Char('\n'));
}

/// "10 s, 1000 values, 100 Hz; ..."
QString QPlcSpectrum::Private::noteOf(const SpectrumJob::Result &result) const
{
    const bool isPicture = shown.kind == SpectrumJob::Picture;
    const std::size_t used = isPicture ? result.picture.samples : result.lines.samples;
    const double step = isPicture ? result.picture.step : result.lines.step;
    QStringList parts{tr("%1 s").arg(double(used) * result.period, 0, 'g', 4), tr("%1 values").arg(used),
                      frequencyText(1.0 / result.period), tr("a line each %1").arg(frequencyText(step))};
    if (shown.kind == SpectrumJob::Density)
        parts << (result.lines.segments == 1 ? tr("1 segment") : tr("mean of %1 segments").arg(result.lines.segments));
    if (isPicture)
        parts << tr("%1 pieces").arg(result.picture.columns);
    const QString text = parts.join(QStringLiteral(", "));
    return result.remark.isEmpty() ? text : tr("%1: %2").arg(result.remark, text);
}

/// What all have in common is told once.
QString QPlcSpectrum::Private::noteText() const
{
    QStringList texts;
    QStringList names;
    for (std::size_t i = 0; i < results.size() && i < shownPasts.size(); ++i) {
        if (!results[i].problem.isEmpty())
            continue;
        texts << noteOf(results[i]);
        names << shownPasts[i].text();
    }
    QString begin;
    if (shown.kind == SpectrumJob::Picture && !texts.isEmpty()) {
        const QDateTime first = QDateTime::fromMSecsSinceEpoch(results.front().begin / 1'000'000);
        begin = tr("%1 from %2: ").arg(names.first(), first.toString(QStringLiteral("hh:mm:ss.zzz")));
    }
    if (texts.isEmpty() || texts.count(texts.first()) == texts.size())
        return texts.isEmpty() ? QString() : begin + texts.first();
    for (int i = 0; i < texts.size(); ++i)
        texts[i] = QStringLiteral("%1: %2").arg(names[i], texts[i]);
    return texts.join(QLatin1Char('\n'));
}

void QPlcSpectrum::Private::showReadout()
{
    const QString text = readoutText();
    const bool isVisible = !canvas->isHidden() && q->height() >= leastHeightOfTexts;
    readout->setText(text.isEmpty() ? QStringLiteral(" ") : text);  // the plot does not jump
    readout->setVisible(isVisible);
}

/// At the mouse, or else at the cursor.
QString QPlcSpectrum::Private::readoutText() const
{
    const std::optional<double> cursor = canvas->cursorFrequency();
    const auto mouse = interaction->mouse();
    if (!mouse && !cursor)
        return {};
    const double frequency = mouse ? canvas->frequencyAt(*mouse) : *cursor;
    if (canvas->isSpectrogram()) {
        const std::optional<double> density
            = mouse ? canvas->densityAt(canvas->timeAt(*mouse), frequency) : std::nullopt;
        if (!density || shownPasts.empty())
            return frequencyText(std::max(frequency, 0.0));
        return tr("%1 s, %2: %3 %4")
            .arg(canvas->timeAt(*mouse), 0, 'f', 2)
            .arg(frequencyText(frequency))
            .arg(*density, 0, 'g', 4)
            .arg(SpectrumCanvas::densityUnit(shownPasts.front().unit));
    }
    QStringList parts;
    for (const SpectrumCanvas::Curve &curve : canvas->curves()) {
        const std::size_t line = canvas->lineNear(curve.lines, frequency);
        if (line == 0)
            continue;
        const double value = curve.lines.values[line];
        const QString text = curve.isDensity
            ? QStringLiteral("%1 %2").arg(value, 0, 'g', 4).arg(SpectrumCanvas::densityUnit(curve.unit))
            : QPlcPanelContext::text(value, curve.unit);
        const QString name = canvas->curves().size() == 1 ? QString() : curve.title + QLatin1Char(' ');
        parts << tr("%1%2 at %3").arg(name, text, frequencyText(double(line) * curve.lines.step));
    }
    return parts.join(QStringLiteral("   "));
}

// ---- what people do ----

void QPlcSpectrum::Private::edit(const char *key, const QJsonValue &value)
{
    if (!settings.set(key, value, defaults.value(QLatin1String(key))))
        return;
    showSettings();
    bind();
    Q_EMIT q->settingsEdited();
}

void QPlcSpectrum::Private::showSettings()
{
    logFrequency->setChecked(setting(logFrequencyKey).toBool());
    logValues->setChecked(setting(logValuesKey).toBool());
    canvas->setLooks({logFrequency->isChecked(), logValues->isChecked()});
}

void QPlcSpectrum::Private::makeActions()
{
    const auto showing = [this](View view) { return [this, view] { edit(spectrumViewKey, views().at(view)); }; };
    addAction(tr("Amplitudes"), {Qt::Key_1}, "amplitude", showing(Amplitude));
    addAction(tr("Power density"), {Qt::Key_2}, "density", showing(Density));
    addAction(tr("Spectrogram"), {Qt::Key_3}, "spectrogram", showing(Spectrogram));
    logFrequency = addAction(tr("Logarithmic frequency"), {Qt::Key_F}, "logFrequency",
                             [this] { edit(logFrequencyKey, logFrequency->isChecked()); });
    logValues = addAction(tr("Logarithmic values"), {Qt::Key_Y}, "logValues",
                          [this] { edit(logValuesKey, logValues->isChecked()); });
    logFrequency->setCheckable(true);
    logValues->setCheckable(true);
    addAction(tr("Spectrogram of the next signal"), {Qt::Key_V}, "next", [this] {
        selected = pasts.empty() ? 0 : (selected + 1) % int(pasts.size());
        edit(spectrumViewKey, views().at(Spectrogram));
        bind();
    });
    interaction->addActions(q);
    addAction(tr("Cursor to the highest line"), {Qt::Key_P}, "highest", [this] { placeAtHighest(); });
    addAction(tr("Cursor one line down"), {int(Qt::CTRL) | Qt::Key_Left}, "lineDown", [this] { moveCursor(-1); });
    addAction(tr("Cursor one line up"), {int(Qt::CTRL) | Qt::Key_Right}, "lineUp", [this] { moveCursor(1); });
    addAction(tr("Remove the cursor"), {Qt::Key_0}, "removeCursor", [this] {
        canvas->placeCursor(std::nullopt);
        showReadout();
    });
    exporter()->addTableActions([this] { return table(); });
    exporter()->addPictureActions();
}

QMenu *QPlcSpectrum::Private::createMenu()
{
    return makeMenu({{"amplitude", "density", "spectrogram", "next"},
                     {"logFrequency", "logValues", "all", "zoomIn", "zoomOut"},
                     {"highest", "lineDown", "lineUp", "removeCursor"},
                     {"saveTable", "copyTable", "savePicture", "copyPicture"},
                     {"panelMenu"}});  // of the frame around
}

void QPlcSpectrum::Private::connectInteraction()
{
    connect(interaction, &XyInteraction::pressed, q, [this] { q->setFocus(Qt::MouseFocusReason); });
    connect(interaction, &XyInteraction::mouseMoved, q, [this] { showReadout(); });
    connect(interaction, &XyInteraction::clicked, q, [this](const QPoint &place) {
        double frequency = canvas->frequencyAt(place);
        if (!canvas->curves().isEmpty()) {
            const Spectrum::Lines &lines = canvas->curves().first().lines;
            frequency = double(canvas->lineNear(lines, frequency)) * lines.step;
        }
        canvas->placeCursor(frequency);
        showReadout();
    });
    connect(interaction, &XyInteraction::menuWanted, q,
            [this](const QPoint &, const QPoint &global) { createMenu()->popup(global); });
}

void QPlcSpectrum::Private::placeAtHighest()
{
    if (canvas->curves().isEmpty())
        return;
    const Spectrum::Lines &lines = canvas->curves().first().lines;
    canvas->placeCursor(double(lines.highest()) * lines.step);
    showReadout();
}

void QPlcSpectrum::Private::moveCursor(int by)
{
    const bool isPicture = shown.kind == SpectrumJob::Picture;
    if (results.empty() || !results.front().problem.isEmpty())
        return;
    const double step = isPicture ? results.front().picture.step : canvas->curves().first().lines.step;
    const std::size_t lines = isPicture ? results.front().picture.lines : canvas->curves().first().lines.values.size();
    const double now = std::round(canvas->cursorFrequency().value_or(0.0) / step);
    canvas->placeCursor(step * std::clamp(now + by, 1.0, double(std::max<std::size_t>(lines, 2) - 1)));
    showReadout();
}

// ---- the panel ----

QPlcSpectrum::QPlcSpectrum(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    d->showSettings();
    d->showLook();
    d->showTexts();
}

QPlcSpectrum::~QPlcSpectrum() = default;

QJsonObject QPlcSpectrum::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcSpectrum::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    d->showSettings();
    d->bind();
}

QStringList QPlcSpectrum::shownSignals() const
{
    return d->references();
}

bool QPlcSpectrum::addSignals(const QStringList &references)
{
    QStringList all = d->references();
    for (const QString &reference : references) {
        if (!all.contains(reference))
            all << reference;
    }
    d->edit(spectrumSignalsKey, QJsonArray::fromStringList(all));
    return !references.isEmpty();
}

QPlcSpectrum::View QPlcSpectrum::view() const
{
    return View(std::max(int(views().indexOf(d->setting(spectrumViewKey).toString())), 0));
}

void QPlcSpectrum::setView(View view)
{
    if (!d->settings.set(spectrumViewKey, views().at(view), defaults.value(QLatin1String(spectrumViewKey))))
        return;
    d->bind();
}

QWidget *QPlcSpectrum::createSettingsEditor()
{
    QJsonObject all;
    for (auto setting = defaults.begin(); setting != defaults.end(); ++setting)
        all.insert(setting.key(), d->setting(setting.key().toLatin1()));
    auto *editor = new SpectrumEditor(d->references(), all);
    connect(editor, &SpectrumEditor::signalsChanged, this, [this](const QStringList &references) {
        d->edit(spectrumSignalsKey, QJsonArray::fromStringList(references));
    });
    connect(editor, &SpectrumEditor::settingChanged, this,
            [this](const QString &key, const QJsonValue &value) { d->edit(key.toLatin1().constData(), value); });
    return editor;
}
