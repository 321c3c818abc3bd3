// SPDX-License-Identifier: Apache-2.0
#include "QPlcGauge.h"

#include "GaugeEditor.h"
#include "GaugeFeed.h"
#include "GaugePaint.h"
#include "QPlcPanelContext.h"
#include "gui/panel/PanelAction.h"

#include <QtWidgets/QAction>

using namespace qplc;

struct QPlcGauge::Private
{
    GaugeFeed feed;
    PanelSettings settings = GaugeSettings::emptyJson();
    bool isInWindow = false;  // else a program gives the values
};

QPlcGauge::QPlcGauge(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    setMinimumSize(72, 56);
    setFocusPolicy(Qt::StrongFocus);
    connect(&d->feed, &GaugeFeed::changed, this, [this] {
        setAccessibleName(d->feed.picture().spoken());
        update();
    });
    connect(this, &QPlcWidget::titleChanged, this,
            [this] { d->feed.setNameShown(!QPlcWidget::settings().contains(QStringLiteral("title"))); });
    addPanelAction(this, tr("Reset smallest and largest value"), {int(Qt::CTRL) | int(Qt::Key_R)},
                   [this] { d->feed.reset(); });
    addStyleAction(tr("Dial"), styleText(GaugeStyle::Dial));
    addStyleAction(tr("Bar"), styleText(GaugeStyle::Bar));
    addStyleAction(tr("Number"), styleText(GaugeStyle::Number));
    addStyleAction(tr("LED"), styleText(GaugeStyle::Led));
}

QPlcGauge::~QPlcGauge() = default;

void QPlcGauge::addStyleAction(const QString &text, const QString &style)
{
    addPanelAction(this, tr("Show as %1").arg(text), {}, [this, style] {
        if (d->settings.set("style", style, styleText(GaugeStyle::Dial)))
            takeEdit();
    });
}

QJsonObject QPlcGauge::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcGauge::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    showSettings();
}

void QPlcGauge::showSettings()
{
    const GaugeSettings settings = GaugeSettings::from(d->settings);
    d->feed.setSettings(settings);
    if (d->isInWindow)
        return;
    QPlcSignalIndexList inputs;
    if (d->feed.definition().name.size() > 0)
        inputs.insert(d->feed.definition().name);
    setInputSignalIndices(inputs);
}

void QPlcGauge::takeEdit()
{
    showSettings();
    Q_EMIT settingsEdited();
}

bool QPlcGauge::addSignals(const QStringList &references)
{
    if (references.isEmpty())
        return false;
    if (d->settings.set("signal", references.first()))
        takeEdit();
    return true;
}

QStringList QPlcGauge::shownSignals() const
{
    const QString signal = d->settings.value("signal").toString();
    return signal.isEmpty() ? QStringList() : QStringList(signal);
}

QWidget *QPlcGauge::createSettingsEditor()
{
    const QString title = QPlcWidget::settings().value(QStringLiteral("title")).toString();
    auto *editor = new GaugeEditor(d->settings, title, d->feed.definition(), context());
    connect(editor, &GaugeEditor::edited, this, [this](const PanelSettings &settings) {
        d->settings = settings;
        takeEdit();
    });
    connect(editor, &GaugeEditor::titleEdited, this, [this](const QString &text) {
        if (text == QPlcWidget::settings().value(QStringLiteral("title")).toString())
            return;
        setTitle(text);
        Q_EMIT settingsEdited();
    });
    return editor;
}

void QPlcGauge::contextChanged()
{
    d->isInWindow = true;
    d->feed.setContext(context());
    installEventFilter(&d->feed);
    connect(context(), &QPlcPanelContext::themeChanged, this, QOverload<>::of(&QWidget::update));
}

void QPlcGauge::realTimeout(const QList<QPlcSignalList> &signalValues)
{
    if (!d->isInWindow && !inputSignalIndices().isEmpty())
        d->feed.add(signalValues, inputSignalIndices().at(0));
}

QSize QPlcGauge::sizeHint() const
{
    return {180, 150};
}

void QPlcGauge::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->feed.setActive(true);
}

void QPlcGauge::hideEvent(QHideEvent *event)
{
    QPlcWidget::hideEvent(event);
    d->feed.setActive(false);
}

void QPlcGauge::paintEvent(QPaintEvent * /*event*/)
{
    const QPlcTheme theme = context()->theme();
    QPainter painter(this);
    painter.fillRect(rect(), theme.surface);
    paintGauge(&painter, rect(), d->feed.picture(), theme);
    if (hasFocus()) {
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(theme.accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(rect().adjusted(0, 0, -1, -1));
    }
}
