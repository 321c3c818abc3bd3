// SPDX-License-Identifier: Apache-2.0
#include "QPlcXyPlot.h"

#include "ChartLook.h"
#include "ChartPanel.h"
#include "QPlcTimeAxis.h"
#include "XyCanvas.h"
#include "XyInteraction.h"
#include "XyPlotEditor.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/PanelSettings.h"
#include "gui/plot/TableExport.h"

#include <QtCore/QDateTime>
#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonArray>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

using namespace qplc;

namespace {

constexpr int shortestPause = 40;  // [ms] between pictures
constexpr int longestPause = 1000;
constexpr int costShare = 4;   // drawing takes at most so small a share of the time
constexpr int agePause = 500;  // [ms]

constexpr const char *xyCurvesKey = "curves";
const QString xKey = QStringLiteral("x");
const QString yKey = QStringLiteral("y");
const QString xyColorKey = QStringLiteral("color");
constexpr const char *aspectKey = "equalAspect";

constexpr int xyDigits = 5;

QString textOf(const QPlcPast &source, double value)
{
    const QString unit = source.unit.isEmpty() ? QString() : QLatin1Char(' ') + source.unit;
    return QStringLiteral("%1%2").arg(numberText(value, xyDigits), unit);
}

}  // namespace

class QPlcXyPlot::Private : public ChartPanel
{
public:
    explicit Private(QPlcXyPlot *plot)
        : ChartPanel(plot, [this] { return std::make_unique<ChartPicture>(canvas, legend->text()); })
        , q(plot)
        , canvas(new XyCanvas)
        , message(new QLabel)
        , legend(new QLabel)
        , moment(new QLabel)
        , interaction(new XyInteraction(canvas, canvas, plot))
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
        setPause(shortestPause);
        setTickPeriod(agePause);
        setQuietTexts();
        makeActions();
        connectInteraction();
    }

    QJsonArray curves() const { return settings.value(xyCurvesKey).toArray(); }

    /// Finds what the expressions mean now.
    void bind() override
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
                names << tr("%1 over %2").arg(QPlcPast::textOf(y), QPlcPast::textOf(x));
            if (x.isEmpty() || y.isEmpty())
                continue;
            const QPlcPast xPast = context()->past(x);
            const QPlcPast yPast = context()->past(y);
            if (xPast && yPast && xPast.plant == yPast.plant) {
                found.push_back(
                    std::make_unique<XyCurve>(xPast, yPast, tr("%1 over %2").arg(yPast.text(), xPast.text())));
                colors.emplace_back(entry[xyColorKey].toString());
            } else if (error.isEmpty()) {
                error = !xPast ? xPast.problem
                    : !yPast   ? yPast.problem
                               : tr("%1 and %2 are of two plants. Remedy: choose signals of one.").arg(x, y);
            }
        }
        canvas->setCurves(std::move(found), colors);
        q->setDefaultTitle(names.join(QStringLiteral(", ")));
        showMessage();
        showLegend();
        schedule();
    }

    void draw() override
    {
        const auto displayed = context()->shownTime();
        QElapsedTimer cost;
        cost.start();
        const bool isStale = !displayed && stale();
        canvas->show({seenEnd() - context()->timeAxis()->span(), seenEnd(), displayed, isStale});
        legend->setVisible(!legend->text().isEmpty() && q->height() >= leastHeightOfTexts);
        setPause(std::clamp(int(cost.elapsed()) * costShare, shortestPause, longestPause));
        showMoment();
    }

    /// What a person has changed.
    void edit(const QJsonArray &edited)
    {
        settings.set(xyCurvesKey, edited, QJsonArray());
        canvas->release();  // what is added is to be seen
        bind();
        Q_EMIT q->settingsEdited();
    }

    void showAspect()
    {
        equal->setChecked(q->isAspectEqual());
        canvas->setAspect(q->isAspectEqual() ? XyCanvas::Equal : XyCanvas::Free);
        schedule();
    }

    void showMessage()
    {
        const QString text = messageText();
        message->setText(text);
        message->setVisible(!text.isEmpty());
        const bool hasCurves = !canvas->curves().empty();
        canvas->setVisible(hasCurves);
        message->setAlignment(hasCurves ? Qt::AlignLeft : Qt::AlignCenter);
        message->setSizePolicy(QSizePolicy::Ignored, hasCurves ? QSizePolicy::Preferred : QSizePolicy::Expanding);
    }

    void showLegend()
    {
        legend->setText(canvas->legend());
        legend->setVisible(!legend->text().isEmpty() && q->height() >= leastHeightOfTexts);
    }

    /// Where the mouse is, or else when the dot was.
    void showMoment()
    {
        const QString text = interaction->mouse() ? pointerText() : timeText();
        moment->setVisible(!text.isEmpty() && !canvas->curves().empty());
        if (text != moment->text())
            moment->setText(text);
    }

    void showTheme(const QPlcTheme &theme) override { canvas->setTheme(theme); }

    QString messageText() const
    {
        const QJsonArray wanted = curves();
        if (wanted.isEmpty())
            return tr("Drop two signals here: the second one is drawn over the first.");
        if (!error.isEmpty())
            return error;
        const QJsonValue last = wanted.last();
        if (last[yKey].toString().isEmpty() && !last[xKey].toString().isEmpty())
            return tr("Drop a second signal here: it is drawn over %1.").arg(last[xKey].toString());
        return canvas->curves().empty() ? tr("Choose signals for x and y in the settings.") : QString();
    }

    /// Empty: the dot is where the plant is.
    QString timeText() const
    {
        const auto displayed = context()->shownTime();
        if (displayed)
            return tr("dot at %1")
                .arg(QDateTime::fromMSecsSinceEpoch(*displayed / 1'000'000).toString(QStringLiteral("hh:mm:ss.zzz")));
        return stale() ? tr("stale, %1").arg(ageText(stale()->age())) : QString();
    }

    /// Of the first curve whose newest values are no longer true; null: all are.
    const QPlcPast *stale() const
    {
        const auto found = std::find_if(canvas->curves().begin(), canvas->curves().end(),
                                        [](const std::unique_ptr<XyCurve> &curve) { return !curve->x().isCurrent(); });
        return found != canvas->curves().end() ? &(*found)->x() : nullptr;
    }

    /// The end of the time that is seen: live, that of the newest values of the plants that are
    /// drawn, as each has a clock of its own.
    QPlcPast::Time seenEnd() const
    {
        QPlcPast::Time newest = 0;
        for (const std::unique_ptr<XyCurve> &curve : canvas->curves())
            newest = std::max(newest, curve->x().newestTime());
        return context()->isLive() && newest > 0 ? newest : context()->timeAxis()->end();
    }

    void makeActions()
    {
        equal = addAction(tr("Equal aspect"), {Qt::Key_E}, "equal", [this] {
            q->setAspectEqual(equal->isChecked());
            Q_EMIT q->settingsEdited();
        });
        equal->setCheckable(true);
        interaction->addActions(q);
        exporter()->addTableActions([this] { return table(); });
        exporter()->addPictureActions();
    }

    void connectInteraction()
    {
        connect(interaction, &XyInteraction::pressed, q, [this] { q->setFocus(Qt::MouseFocusReason); });
        connect(interaction, &XyInteraction::mouseMoved, q, [this] { showMoment(); });
        connect(interaction, &XyInteraction::menuWanted, q,
                [this](const QPoint &, const QPoint &global) { createMenu()->popup(global); });
    }

    QMenu *createMenu() override
    {
        return makeMenu({{"all", "zoomIn", "zoomOut", "equal"},
                         {"saveTable", "copyTable", "savePicture", "copyPicture"},
                         {"panelMenu"}});  // of the frame around
    }

    /// x and y below the mouse.
    QString pointerText() const
    {
        if (canvas->curves().empty())
            return {};
        const QPointF at = canvas->valueAt(*interaction->mouse());
        const XyCurve &first = *canvas->curves().front();
        return tr("x %1   y %2").arg(textOf(first.x(), at.x()), textOf(first.y(), at.y()));
    }

    /// The rows of the time that is seen at the moment of the wish; what several curves have in
    /// common is one column.
    ChartExport::Table table() const
    {
        const QPlcPast::Time end = seenEnd();
        const QPlcPast::Time begin = end - context()->timeAxis()->span();
        return [this, begin, end](TableText::Format format) {
            std::vector<TableExport::Column> columns;
            QStringList added;
            for (const std::unique_ptr<XyCurve> &curve : canvas->curves()) {
                for (const QPlcPast &past : {curve->x(), curve->y()}) {
                    if (!added.contains(past.expression)) {
                        columns.push_back(TableExport::Column::of(past, past.text()));
                        columns.back().hasQuality = format == TableText::Csv;
                    }
                    added << past.expression;
                }
            }
            return std::make_shared<TableExport>(format, std::move(columns), begin, end);
        };
    }

    QPlcXyPlot *q;
    XyCanvas *canvas;
    QLabel *message;  // what is missing
    QLabel *legend;
    QLabel *moment;  // when the dot was
    XyInteraction *interaction;
    QAction *equal = nullptr;
    PanelSettings settings{"curves", "equalAspect"};
    QString error;  // of the first curve that cannot be drawn
};

QPlcXyPlot::QPlcXyPlot(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    d->showLook();
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
