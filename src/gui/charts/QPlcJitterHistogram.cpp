// SPDX-License-Identifier: Apache-2.0
#include "QPlcJitterHistogram.h"

#include "ChartLook.h"
#include "ChartPanel.h"
#include "JitterCanvas.h"
#include "JitterEditor.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/PanelSettings.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonArray>
#include <QtCore/QMap>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

using namespace qplc;

namespace {

constexpr int askPause = 1000;    // [ms]
constexpr int staleAfter = 3000;  // [ms]

constexpr const char *showKey = "show";
constexpr const char *windowKey = "window";
const QString sinceStart = QStringLiteral("sinceStart");
const QString last10s = QStringLiteral("last10s");
const QString masterLateness = JitterDistribution::keyOfMaster(JitterDistribution::Lateness);

}  // namespace

class QPlcJitterHistogram::Private : public ChartPanel
{
public:
    explicit Private(QPlcJitterHistogram *histogram)
        : ChartPanel(histogram, [this] { return std::make_unique<ChartPicture>(canvas, caption->text()); })
        , q(histogram)
        , canvas(new JitterCanvas)
        , message(new QLabel)
        , caption(new QLabel)
    {
        auto *all = new QVBoxLayout(q);
        all->setContentsMargins(2, 2, 2, 2);
        all->setSpacing(0);
        all->addWidget(message, 1);
        all->addWidget(canvas, 1);
        all->addWidget(caption);
        message->setWordWrap(true);
        message->setMargin(6);
        message->setAlignment(Qt::AlignCenter);
        message->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Expanding);
        caption->setMargin(2);
        caption->setTextFormat(Qt::RichText);
        caption->setWordWrap(true);
        caption->setAlignment(Qt::AlignRight);
        caption->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        caption->setFont(scaleFont(caption->font()));
        canvas->setAccessibleName(tr("Histogram of durations"));
        setTickPeriod(askPause);
        setQuietTexts();
        makeActions();
    }

    void makeActions()
    {
        last = addAction(tr("Only the last 10 s"), {Qt::Key_T}, "last10s", [this] {
            settings.set(windowKey, last->isChecked() ? last10s : sinceStart, sinceStart);
            draw();
            Q_EMIT q->settingsEdited();
        });
        last->setCheckable(true);
        const QVector<QPair<const char *, int>> quantities{{JitterDistribution::Lateness, Qt::Key_L},
                                                           {JitterDistribution::Execution, Qt::Key_X},
                                                           {JitterDistribution::RoundTrip, Qt::Key_R}};
        for (const auto &[quantity, shortcut] : quantities) {
            const QString key = JitterDistribution::keyOfMaster(quantity);
            QAction *action = addAction(JitterDistribution::titleOf(key), {shortcut}, qPrintable(key),
                                        [this, key] { setShown(key, masterActions[key]->isChecked()); });
            action->setCheckable(true);
            masterActions.insert(key, action);
        }
        exporter()->addPictureActions();
        showActions();
    }

    void bind() override { tick(); }
    void tick() override
    {
        ask();
        draw();
    }

    void takeValues() override {}
    void takeTime() override {}
    void resized() override { draw(); }
    /// A person's choice.
    void setPlant(const QString &name)
    {
        if (name == q->pinnedPlant())
            return;
        q->setPinnedPlant(name);
        Q_EMIT q->settingsEdited();
    }

    void ask()
    {
        if (!q->isVisible())
            return;
        const QString name = context()->plant().name;
        if (asked != name) {
            durations.clear();
            sinceAnswer.invalidate();
        }
        asked = name;
        context()->askDurations(receiver(), [this, name](const QVector<QPlcPanelContext::Duration> &answer) {
            if (name != asked)
                return;
            durations = answer;
            sinceAnswer.start();
            draw();
        });
    }

    QVector<JitterDistribution> distributions(QPlcDistribution QPlcDurationStatistics::*window) const
    {
        return jitterDistributions(durations, window);
    }
    void draw() override
    {
        const bool isLast = settings.value(windowKey).toString() == last10s;
        const QVector<JitterDistribution> all
            = distributions(isLast ? &QPlcDurationStatistics::last10s : &QPlcDurationStatistics::sinceStart);
        QVector<JitterDistribution> shown;
        const QStringList keys = shownKeys();
        for (const QString &key : keys) {
            const auto found
                = std::find_if(all.begin(), all.end(), [&](const auto &each) { return each.key() == key; });
            if (found != all.end())
                shown.append(*found);
        }
        const QString text = problem(shown);
        message->setText(text);
        message->setVisible(!text.isEmpty());
        canvas->setVisible(text.isEmpty());
        const bool isStale = !sinceAnswer.isValid() || sinceAnswer.elapsed() > staleAfter;
        caption->setVisible(text.isEmpty() && (isStale || q->height() >= leastHeightOfTexts));
        if (!text.isEmpty())
            return;
        canvas->show(shown, isStale);
        caption->setText(captionText(shown, isStale));
    }

    /// What keeps the histogram from being drawn; empty: nothing.
    QString problem(const QVector<JitterDistribution> &shown) const
    {
        const QPlcPanelContext::Plant of = context()->plant();
        if (of.name.isEmpty()) {
            const QString name = q->pinnedPlant();
            return name.isEmpty() ? tr("There is no plant yet.") : tr("There is no plant %1 at the moment.").arg(name);
        }
        if (shownKeys().isEmpty())
            return tr("Choose what to show in the settings.");
        const bool hasValues
            = std::any_of(shown.begin(), shown.end(), [](const auto &each) { return each.count > 0.0; });
        if (hasValues)
            return {};
        if (!of.isConnected)
            return of.stateText;
        if (of.clock.startsWith(QLatin1String("Lockstep"), Qt::CaseInsensitive))
            return tr("In lockstep no clock is read: there is nothing to measure.");
        if (of.clock.startsWith(QLatin1String("External"), Qt::CaseInsensitive))
            return tr("A program turns the clock of this plant: there is nothing to measure.");
        if (sinceAnswer.isValid() && shown.size() < shownKeys().size() && !shown.isEmpty())
            return tr("No values yet.");
        return !sinceAnswer.isValid() || !shown.isEmpty()
            ? tr("No cycles yet. Start the plant to measure its punctuality.")
            : tr("There are no figures of %1 at the moment.").arg(shownKeys().join(QStringLiteral(", ")));
    }

    /// One line of what has room, the most important last; the names of several histograms may take
    /// more lines.
    QString captionText(const QVector<JitterDistribution> &shown, bool isStale) const
    {
        QStringList parts;
        if (shown.size() == 1)
            parts << tr("%1 values").arg(shown.first().count, 0, 'f', 0);
        parts << (settings.value(windowKey).toString() == last10s ? tr("last 10 s") : tr("since start"));
        QStringList what;
        if (context()->plants().size() > 1)
            what << context()->plant().name;
        if (shown.size() == 1)
            what << shown.first().title();
        if (!what.isEmpty())
            parts << what.join(QStringLiteral(": "));
        if (isStale)
            parts << tr("stale, %1").arg(ageText(double(sinceAnswer.elapsed()) * 1e-3));
        const bool isSmall = q->height() < leastHeightOfTexts;
        const auto text = [&] { return parts.join(QStringLiteral(" · ")); };
        const QFontMetrics metrics(caption->font());
        while (parts.size() > 1 && (isSmall || metrics.horizontalAdvance(text()) > q->width() - 4 * caption->margin()))
            parts.removeFirst();
        const QString legend = isSmall ? QString() : canvas->legend();
        return legend.isEmpty() ? text().toHtmlEscaped() : text().toHtmlEscaped() + QStringLiteral(" &nbsp; ") + legend;
    }

    QStringList shownKeys() const
    {
        if (settings.value(showKey).isUndefined())
            return {masterLateness};
        QStringList keys;
        const QJsonArray shown = settings.value(showKey).toArray();
        for (const QJsonValue &key : shown)
            keys << key.toString();
        return keys;
    }

    /// A person's choice.
    void setShown(const QString &key, bool isShown)
    {
        QStringList keys = shownKeys();
        keys.removeAll(key);
        if (isShown)
            keys << key;
        settings.set(showKey, QJsonArray::fromStringList(keys), QJsonArray{masterLateness});
        showActions();
        draw();
        Q_EMIT q->settingsEdited();
    }

    void showActions()
    {
        last->setChecked(settings.value(windowKey).toString() == last10s);
        for (auto action = masterActions.begin(); action != masterActions.end(); ++action)
            action.value()->setChecked(shownKeys().contains(action.key()));
    }

    void showTheme(const QPlcTheme &theme) override { canvas->setTheme(theme); }

    QPlcJitterHistogram *q;
    JitterCanvas *canvas;
    QLabel *message;
    QLabel *caption;
    QAction *last = nullptr;
    QMap<QString, QAction *> masterActions;  // by key
    PanelSettings settings{showKey, windowKey};
    QVector<QPlcPanelContext::Duration> durations;
    QString asked;  // the plant whose durations these are
    QElapsedTimer sinceAnswer;
};

QPlcJitterHistogram::QPlcJitterHistogram(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    d->showLook();
}

QPlcJitterHistogram::~QPlcJitterHistogram() = default;

QJsonObject QPlcJitterHistogram::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcJitterHistogram::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    d->showActions();
    d->tick();
}

QWidget *QPlcJitterHistogram::createSettingsEditor()
{
    QStringList keys;
    for (const JitterDistribution &distribution : d->distributions(&QPlcDurationStatistics::sinceStart))
        keys << distribution.key();
    for (const QString &key : d->masterActions.keys() + d->shownKeys()) {
        if (!keys.contains(key))
            keys << key;
    }
    auto *editor = new JitterEditor(keys, d->shownKeys(), d->last->isChecked());
    const QStringList plants = context()->plants();
    if (plants.size() > 1 || !pinnedPlant().isEmpty())
        editor->addPlants(plants, pinnedPlant());
    connect(editor, &JitterEditor::plantChanged, this, [this](const QString &plant) { d->setPlant(plant); });
    connect(editor, &JitterEditor::shownChanged, this,
            [this](const QString &key, bool isShown) { d->setShown(key, isShown); });
    connect(editor, &JitterEditor::lastChanged, this, [this](bool isLast) {
        if (isLast != d->last->isChecked())
            d->last->trigger();
    });
    return editor;
}
