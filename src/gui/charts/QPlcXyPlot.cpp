// SPDX-License-Identifier: Apache-2.0
#include "QPlcXyPlot.h"

#include "ChartLook.h"
#include "QPlcXyPlotPrivate.h"
#include "XyPlotEditor.h"
#include "gui/models/ValueFormat.h"

#include <QtCore/QDateTime>
#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonArray>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

using namespace qplc;

namespace {

constexpr int longestPause = 1000;
constexpr int costShare = 4;   // drawing takes at most so small a share of the time
constexpr int agePause = 500;  // [ms]

constexpr const char *xyCurvesKey = "curves";
const QString xKey = QStringLiteral("x");
const QString yKey = QStringLiteral("y");
const QString xyColorKey = QStringLiteral("color");
constexpr const char *aspectKey = "equalAspect";

}  // namespace

QPlcXyPlot::Private::Private(QPlcXyPlot *plot)
    : q(plot)
    , canvas(new XyCanvas)
    , message(new QLabel)
    , legend(new QLabel)
    , moment(new QLabel)
    , interaction(new XyInteraction(canvas, plot))
    , exporter(new ChartExport(plot, [this] { return std::make_unique<ChartPicture>(canvas, legend->text()); }))
{
    auto *all = new QVBoxLayout(plot);
    all->setContentsMargins(2, 2, 2, 2);
    all->setSpacing(0);
    all->addWidget(message);
    all->addWidget(legend);
    all->addWidget(canvas, 1);
    all->addWidget(moment);
    message->setWordWrap(true);
    message->setMargin(6);
    message->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    legend->setWordWrap(true);
    legend->setMargin(4);
    legend->setFont(scaleFont(legend->font()));
    legend->setTextFormat(Qt::RichText);
    legend->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    moment->setMargin(2);
    moment->setFont(scaleFont(moment->font()));
    moment->setAlignment(Qt::AlignRight);
    canvas->setAccessibleName(tr("XY plot"));
    plot->setFocusPolicy(Qt::StrongFocus);
    redraw.setSingleShot(true);
    connect(&redraw, &QTimer::timeout, plot, [this] { draw(); });
    connect(&age, &QTimer::timeout, plot, [this] { schedule(); });
    makeActions();
    connectInteraction();
}

/// Finds what the expressions mean now.
void QPlcXyPlot::Private::bind()
{
    std::vector<std::unique_ptr<XyCurve>> found;
    std::vector<QColor> colors;
    error.clear();
    const QJsonArray wanted = curves();
    QStringList names;
    for (const QJsonValue &entry : wanted) {
        const QString x = entry[xKey].toString();
        const QString y = entry[yKey].toString();
        if (!x.isEmpty() && !y.isEmpty())
            names << tr("%1 over %2").arg(CurveSource::textOf(y), CurveSource::textOf(x));
        if (!q->windowContext() || x.isEmpty() || y.isEmpty())
            continue;
        const CurveSource xSource = q->windowContext()->curveSources()->find(x, q->pinnedPlant());
        const CurveSource ySource = q->windowContext()->curveSources()->find(y, q->pinnedPlant());
        const bool isOfOne = xSource.plant == ySource.plant;
        if (xSource && ySource && isOfOne) {
            found.push_back(std::make_unique<XyCurve>(
                xSource, ySource, tr("%1 over %2").arg(CurveSource::textOf(y), CurveSource::textOf(x))));
            colors.emplace_back(entry[xyColorKey].toString());
        } else if (error.isEmpty()) {
            error = !xSource ? xSource.error
                : !ySource   ? ySource.error
                             : tr("%1 and %2 are of two plants. Remedy: choose signals of one.").arg(x, y);
        }
    }
    canvas->setCurves(std::move(found), colors);
    q->setDefaultTitle(names.join(QStringLiteral(", ")));
    showMessage();
    showLegend();
    schedule();
}

QString QPlcXyPlot::Private::messageText(const QString &problem) const
{
    if (!q->windowContext())
        return tr("No window shares its plants with this plot.");
    const QJsonArray wanted = curves();
    if (wanted.isEmpty())
        return tr("Drop two signals here: the second one is drawn over the first.");
    if (!problem.isEmpty())
        return problem;
    const QJsonValue last = wanted.last();
    if (last[yKey].toString().isEmpty() && !last[xKey].toString().isEmpty())
        return tr("Drop a second signal here: it is drawn over %1.").arg(last[xKey].toString());
    return canvas->curves().empty() ? tr("Choose signals for x and y in the settings.") : QString();
}

void QPlcXyPlot::Private::showMessage()
{
    const QString text = messageText(error);
    message->setText(text);
    message->setVisible(!text.isEmpty());
    const bool hasCurves = !canvas->curves().empty();
    canvas->setVisible(hasCurves);
    message->setAlignment(hasCurves ? Qt::AlignLeft : Qt::AlignCenter);
    message->setSizePolicy(QSizePolicy::Ignored, hasCurves ? QSizePolicy::Preferred : QSizePolicy::Expanding);
}

void QPlcXyPlot::Private::showLegend()
{
    legend->setText(canvas->legend());
    legend->setVisible(!legend->text().isEmpty() && q->height() >= leastHeightOfTexts);
}

void QPlcXyPlot::Private::follow(WindowContext *context)
{
    const TimeView *time = context->timeView();
    const auto scheduled = [this] { schedule(); };
    connect(time, &TimeView::viewChanged, q, scheduled);
    connect(context, &WindowContext::valuesChanged, q, scheduled);
    connect(time, &TimeView::displayTimeChanged, q, scheduled);
    connect(context->curveSources(), &CurveSources::filled, q, scheduled);
    connect(context->curveSources(), &CurveSources::changed, q, [this] {
        exporter->cancel(tr("The signals have changed while they were exported. Export them again."));
        bind();
    });
    connect(context, &WindowContext::themeChanged, q, [this] { applyTheme(); });
}

void QPlcXyPlot::Private::applyTheme()
{
    const Theme &theme = q->windowContext()->theme();
    canvas->setTheme(theme);
    exporter->setTheme(theme);
    showLegend();
    QPalette palette = theme.palette();
    palette.setColor(QPalette::Window, theme.surface);
    palette.setColor(QPalette::WindowText, theme.mutedText);
    q->setPalette(palette);
    q->setAutoFillBackground(true);
    schedule();
}

void QPlcXyPlot::Private::schedule()
{
    if (q->isVisible() && q->windowContext() && !redraw.isActive())
        redraw.start(pause);
}

/// The first plant whose newest values are no longer true.
const Plant *QPlcXyPlot::Private::stalePlant() const
{
    for (const std::unique_ptr<XyCurve> &curve : canvas->curves()) {
        const Plant *plant = curve->xSource().plant;
        if (plant->quality() == Plant::Stale)
            return plant;
    }
    return nullptr;
}

/// The end of the time that is seen: live, that of the newest values of the plants that are drawn, as each has a clock of its own.
SignalStore::Time QPlcXyPlot::Private::seenEnd() const
{
    const TimeView *time = q->windowContext()->timeView();
    SignalStore::Time newest = 0;
    for (const std::unique_ptr<XyCurve> &curve : canvas->curves())
        newest = std::max(newest, curve->xSource().plant->newestTime());
    return time->isLive() && newest > 0 ? newest : time->end();
}

void QPlcXyPlot::Private::draw()
{
    if (!q->isVisible() || !q->windowContext())
        return;
    const auto displayed = q->windowContext()->timeView()->displayTime();
    QElapsedTimer cost;
    cost.start();
    const bool isStale = !displayed && stalePlant();
    canvas->show({seenEnd() - q->windowContext()->timeView()->span(), seenEnd(), displayed, isStale});
    legend->setVisible(!legend->text().isEmpty() && q->height() >= leastHeightOfTexts);
    pause = std::clamp(int(cost.elapsed()) * costShare, shortestPause, longestPause);
    showMoment();
}

/// Where the mouse is, or else when the dot was.
void QPlcXyPlot::Private::showMoment()
{
    if (!q->windowContext())
        return;
    const QString text = interaction->mouse() ? pointerText() : timeText();
    moment->setVisible(!text.isEmpty() && !canvas->curves().empty());
    if (text != moment->text())
        moment->setText(text);
}

/// Empty: the dot is where the plant is.
QString QPlcXyPlot::Private::timeText() const
{
    const auto displayed = q->windowContext()->timeView()->displayTime();
    if (displayed)
        return tr("dot at %1")
            .arg(QDateTime::fromMSecsSinceEpoch(*displayed / 1'000'000).toString(QStringLiteral("hh:mm:ss.zzz")));
    const Plant *plant = stalePlant();
    return plant ? tr("stale, %1").arg(ageText(plant->age())) : QString();
}

QJsonArray QPlcXyPlot::Private::curves() const
{
    return settings.value(xyCurvesKey).toArray();
}

void QPlcXyPlot::Private::showAspect()
{
    equal->setChecked(q->isAspectEqual());
    canvas->setAspect(q->isAspectEqual() ? XyCanvas::Equal : XyCanvas::Free);
    schedule();
}

/// What a person has changed.
void QPlcXyPlot::Private::edit(const QJsonArray &edited)
{
    settings.set(xyCurvesKey, edited, QJsonArray());
    canvas->release();  // what is added is to be seen
    bind();
    Q_EMIT q->settingsEdited();
}

QPlcXyPlot::QPlcXyPlot(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    connect(this, &QPlcWidget::pinnedPlantChanged, this, [this] { d->bind(); });
    d->bind();
}

QPlcXyPlot::~QPlcXyPlot() = default;

QJsonObject QPlcXyPlot::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcXyPlot::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    d->showAspect();
    d->bind();
}

bool QPlcXyPlot::isAspectEqual() const
{
    return d->settings.value(aspectKey).toBool();
}

void QPlcXyPlot::setAspectEqual(bool isEqual)
{
    if (isEqual == isAspectEqual())
        return;
    d->settings.set(aspectKey, isEqual, false);
    d->showAspect();
}

bool QPlcXyPlot::addSignals(const QStringList &references)
{
    QJsonArray curves = d->curves();
    for (const QString &reference : references) {
        QJsonObject last = curves.isEmpty() ? QJsonObject() : curves.last().toObject();
        const bool isWaiting = !last[xKey].toString().isEmpty() && last[yKey].toString().isEmpty();
        if (!isWaiting) {
            curves.append(QJsonObject{{xKey, reference}});
            continue;
        }
        last.insert(yKey, reference);
        curves.replace(curves.size() - 1, last);
    }
    if (references.isEmpty())
        return false;
    d->edit(curves);
    return true;
}

QStringList QPlcXyPlot::shownSignals() const
{
    QStringList names;
    const QJsonArray shown = d->curves();
    for (const QJsonValue &curve : shown)
        names << curve[xKey].toString() << curve[yKey].toString();
    return names;
}

QWidget *QPlcXyPlot::createSettingsEditor()
{
    QVector<XyPlotEditor::Expressions> expressions;
    const QJsonArray shown = d->curves();
    for (const QJsonValue &curve : shown)
        expressions.append({curve[xKey].toString(), curve[yKey].toString()});
    auto *editor = new XyPlotEditor(expressions, isAspectEqual());
    connect(editor, &XyPlotEditor::expressionChanged, this, [this](int curve, const QString &x, const QString &y) {
        QJsonArray curves = d->curves();
        QJsonObject object = curves.at(curve).toObject();
        object.insert(xKey, x);
        object.insert(yKey, y);
        curves.replace(curve, object);
        d->edit(curves);
    });
    connect(editor, &XyPlotEditor::curveAdded, this, [this] {
        QJsonArray curves = d->curves();
        curves.append(QJsonObject());
        d->edit(curves);
    });
    connect(editor, &XyPlotEditor::curveRemoved, this, [this](int curve) {
        QJsonArray curves = d->curves();
        curves.removeAt(curve);
        d->edit(curves);
    });
    connect(editor, &XyPlotEditor::equalAspectChanged, d->equal, [this](bool isEqual) {
        if (isEqual != isAspectEqual())
            d->equal->trigger();
    });
    return editor;
}

void QPlcXyPlot::contextChanged()
{
    if (!windowContext())
        return;
    d->follow(windowContext());
    d->applyTheme();
    d->bind();
}

void QPlcXyPlot::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->age.start(agePause);
    d->schedule();
}

void QPlcXyPlot::hideEvent(QHideEvent *event)
{
    QPlcWidget::hideEvent(event);
    d->age.stop();
    d->redraw.stop();
}

void QPlcXyPlot::contextMenuEvent(QContextMenuEvent *event)
{
    d->createMenu()->popup(event->globalPos());
    event->accept();
}

void QPlcXyPlot::keyPressEvent(QKeyEvent *event)
{
    if (event->key() != Qt::Key_Escape || !d->exporter->dismiss())
        QPlcWidget::keyPressEvent(event);
}
