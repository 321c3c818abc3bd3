// SPDX-License-Identifier: Apache-2.0
#include "QPlcWindWindow.h"

#include "KiteSettingsEditor.h"
#include "KiteSignals.h"
#include "WindWindowDrawing.h"

#include <QtCore/QTimer>

using namespace qplc;

struct QPlcWindWindow::Private
{
    KiteSignals kite;
    FlightTrail trail;
    QTimer frame;  // runs while a picture was drawn so recently that the next one has to wait
    bool isDue = false;

    static constexpr int frameTime = 33;  // [ms]

    void draw(QPainter *painter, const QSizeF &size, const Theme &theme)
    {
        const KiteState state = kite.state();
        kite.readTrail(&trail);
        const ColorScale scale = kite.colorScale(trail);
        WindWindowDrawing drawing(painter, size, theme);
        drawing.drawSky();
        drawing.drawWind(state);
        drawing.drawTrail(trail, scale, state.downwind());
        drawing.drawKite(state);
        drawing.drawCorners(state, scale, kite.colorTitle());
    }
};

QPlcWindWindow::QPlcWindWindow(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    setAccessibleName(tr("Wind window: the kite as seen from the ground station"));
    setFocusPolicy(Qt::ClickFocus);
    d->frame.setSingleShot(true);
    d->frame.setInterval(Private::frameTime);
    connect(this, &QPlcWidget::pinnedPlantChanged, this, [this] { d->kite.setPin(pinnedPlant()); });
    connect(&d->kite, &KiteSignals::changed, this, [this] {
        d->isDue = true;
        if (!d->frame.isActive() && isVisible())
            update();
    });
    connect(&d->frame, &QTimer::timeout, this, [this] {
        if (d->isDue && isVisible())
            update();
    });
}

QPlcWindWindow::~QPlcWindWindow() = default;

QJsonObject QPlcWindWindow::settings() const
{
    QJsonObject all = QPlcWidget::settings();
    const QJsonObject own = d->kite.settings().toJson();
    for (auto entry = own.begin(); entry != own.end(); ++entry)
        all.insert(entry.key(), entry.value());
    return all;
}

void QPlcWindWindow::applySettings(const QJsonObject &settings)
{
    QJsonObject others;
    d->kite.setSettings(KiteSettings::fromJson(settings, &others));
    QPlcWidget::applySettings(others);
}

QWidget *QPlcWindWindow::createSettingsEditor()
{
    auto *editor = new KiteSettingsEditor(d->kite.settings());
    connect(editor, &KiteSettingsEditor::edited, this, [this, editor] {
        d->kite.setSettings(editor->settings());
        Q_EMIT settingsEdited();
    });
    return editor;
}

bool QPlcWindWindow::addSignals(const QStringList &references)
{
    if (references.isEmpty())
        return false;
    KiteSettings settings = d->kite.settings();
    settings.color = references.first();
    d->kite.setSettings(settings);
    Q_EMIT settingsEdited();
    return true;
}

QSize QPlcWindWindow::minimumSizeHint() const
{
    return {120, 90};
}

QSize QPlcWindWindow::sizeHint() const
{
    return {420, 260};
}

QStringList QPlcWindWindow::shownSignals() const
{
    return {d->kite.settings().position};
}

void QPlcWindWindow::contextChanged()
{
    d->kite.setContext(windowContext());
    if (windowContext())
        connect(windowContext(), &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
}

void QPlcWindWindow::showEvent(QShowEvent *event)
{
    update();
    QPlcWidget::showEvent(event);
}

void QPlcWindWindow::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.setFont(labelFont(font()));
    const Theme theme = windowContext() ? windowContext()->theme() : Theme::byName(Theme::System);
    const QString problem = d->kite.problem();
    if (problem.isEmpty()) {
        d->draw(&painter, size(), theme);
    } else {
        WindWindowDrawing(&painter, size(), theme).drawSky();
        painter.fillRect(rect(), QColor(theme.surface.red(), theme.surface.green(), theme.surface.blue(), 190));
        painter.setFont(font());
        drawHint(&painter, rect(), problem, theme);
    }
    d->isDue = false;
    d->frame.start();
}
