// SPDX-License-Identifier: Apache-2.0
#include "QPlcKeyboardControl.h"
#include "QPlcPanelContext.h"

#include "ControlBar.h"
#include "ElidedLabel.h"
#include "Gamepad.h"
#include "KeyMapEditor.h"
#include "KeyMapView.h"
#include "ManualControl.h"

#include <QtCore/QTimer>
#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAction>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

struct QPlcKeyboardControl::Private
{
    explicit Private(QPlcKeyboardControl *panel)
        : q(panel)
        , control(panel->context())
        , bar(new ControlBar(&control.control(), ControlBar::Large, panel))
        , keys(new KeyMapView(&control, panel))
        , hintLabel(new ElidedLabel(panel))
        , arm(new QAction(tr("Arm gamepad"), panel))
    {
        makeLayout();
        makeArmAction();
        constexpr int tenth = 100;  // [ms]
        pause.setSingleShot(true);
        pause.setInterval(tenth);
        connect(&pause, &QTimer::timeout, panel, [this] {
            if (isOutdated)
                showValues();
        });
        connect(q->context(), &QPlcPanelContext::valuesChanged, panel, [this] {
            isOutdated = true;
            if (!pause.isActive())
                showValues();
        });
        connect(&control.control(), &QPlcSignalControl::changed, panel, [this] { showState(); });
        connect(&control, &ManualControl::moved, panel, [this] { showState(); });
        connect(bar, &ControlBar::handled, panel, [this] { q->setFocus(Qt::OtherFocusReason); });
    }

    void makeLayout()
    {
        auto *column = new QVBoxLayout(q);
        column->setContentsMargins(8, 5, 8, 5);
        column->setSpacing(4);
        column->addWidget(bar);
        auto *scroll = new QScrollArea(q);
        scroll->setWidget(keys);
        scroll->setWidgetResizable(true);
        scroll->setFrameShape(QFrame::NoFrame);
        scroll->setFocusPolicy(Qt::NoFocus);
        scroll->viewport()->setAutoFillBackground(false);
        keys->setAutoFillBackground(false);
        column->addWidget(scroll, 1);
        hintLabel->setMostLines(3);
        auto *row = new QHBoxLayout;
        row->addWidget(hintLabel, 1);
        auto *armButton = new QToolButton(q);
        armButton->setDefaultAction(arm);
        armButton->setFocusPolicy(Qt::NoFocus);  // the keyboard stays with the keys that steer
        row->addWidget(armButton);
        connect(arm, &QAction::changed, armButton, [this, armButton] { armButton->setVisible(arm->isVisible()); });
        column->addLayout(row);
    }

    void makeArmAction()
    {
        arm->setCheckable(true);
        arm->setVisible(false);
        arm->setShortcut(tr("Ctrl+J"));  // as in joystick; Ctrl+G gives back
        arm->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        arm->setToolTip(tr("Axes act while they are armed (Ctrl+J, or the lower button of the gamepad)"));
        connect(arm, &QAction::triggered, q, [this](bool checked) {
            q->setFocus(Qt::OtherFocusReason);
            control.setArmed(checked && control.isFlying() && q->hasFocus());
            showState();
        });
    }

    void apply(const ManualBindings &bindings)
    {
        control.setBindings(bindings);
        if (bindings.axes.isEmpty()) {
            gamepad.reset();
        } else if (!gamepad) {
            gamepad = std::make_unique<Gamepad>();
            connect(gamepad.get(), &Gamepad::axisMoved, &control, &ManualControl::moveAxis);
            connect(gamepad.get(), &Gamepad::armPressed, arm, &QAction::trigger);
            connect(gamepad.get(), &Gamepad::connectedChanged, q, [this] {
                control.setArmed(false);  // the axes of one that is gone say nothing any more
                showState();
            });
        }
        showState();
    }

    void showState()
    {
        hintLabel->showText(hint());
        arm->setVisible(hasGamepad());
        arm->setEnabled(control.isFlying() && hasGamepad());
        arm->setChecked(control.isArmed());
        if (isInWindow) {
            const QPlcTheme theme = q->context()->theme();
            hintLabel->setColor(control.isFlying() && !q->hasFocus() ? theme.warning : theme.mutedText);
        }
        keys->setAxesShown(hasGamepad());
        q->update();
    }

    void showValues()
    {
        isOutdated = false;
        if (!q->isVisible())
            return;
        pause.start();
        keys->refresh();
    }

    void showTheme()
    {
        const QPlcTheme theme = q->context()->theme();
        bar->setTheme(theme);
        keys->setTheme(theme);
        showState();
    }

    bool hasGamepad() const { return gamepad && gamepad->isConnected(); }
    QString hint() const
    {
        if (control.bindings().keys.isEmpty() && control.bindings().axes.isEmpty())
            return tr("No keys yet: choose some in the settings");
        if (control.bindings().keys.isEmpty() && !hasGamepad())
            return gamepad->absence();
        const QString neutral = control.control().neutralText();
        if (!control.isFlying())
            return neutral.isEmpty() ? QString() : tr("Take control: these keys begin at neutral (%1)").arg(neutral);
        return q->hasFocus() ? tr("Hold a key to steer: let go, and it is neutral")
                             : tr("Click here to steer: the keyboard is elsewhere");
    }

    QPlcKeyboardControl *const q;
    ManualControl control;
    std::unique_ptr<Gamepad> gamepad;  // when there is a use for it
    ControlBar *bar;
    KeyMapView *keys;
    ElidedLabel *hintLabel;
    QAction *arm;
    QTimer pause;  // between two looks at the values
    bool isOutdated = false;
    bool isInWindow = false;
};

QPlcKeyboardControl::QPlcKeyboardControl(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Keyboard control"));
    addActions({d->bar->takeAction(), d->bar->giveBackAction(), d->arm});
    d->showState();
}

QPlcKeyboardControl::~QPlcKeyboardControl()
{
    d->control.endHold();
    delete d->keys;  // looks at what ends with this object
}

QJsonObject QPlcKeyboardControl::settings() const
{
    return settingsWith(d->control.bindings().toJson());
}

void QPlcKeyboardControl::applySettings(const QJsonObject &settings)
{
    QJsonObject others = settings;
    others.remove(QStringLiteral("keys"));
    others.remove(QStringLiteral("axes"));
    QPlcWidget::applySettings(others);
    d->apply(ManualBindings::fromJson(settings));
}

QWidget *QPlcKeyboardControl::createSettingsEditor()
{
    auto *editor = new KeyMapEditor(d->control.bindings(), context());
    connect(editor, &KeyMapEditor::edited, this, [this](const ManualBindings &bindings) {
        d->apply(bindings);
        Q_EMIT settingsEdited();
    });
    return editor;
}

QStringList QPlcKeyboardControl::shownSignals() const
{
    QStringList names;
    const QVector<SignalReference> references = d->control.bindings().signalReferences();
    for (const SignalReference &reference : references)
        names << reference.toString();
    return names;
}

void QPlcKeyboardControl::contextChanged()
{
    d->isInWindow = true;
    connect(context(), &QPlcPanelContext::themeChanged, this, [this] { d->showTheme(); });
    d->showTheme();
}

namespace {

/// Whether the key stands for itself: with these it is a shortcut.
bool isPlain(const QKeyEvent *event)
{
    return (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) == 0;
}

}  // namespace

bool QPlcKeyboardControl::event(QEvent *event)
{
    if (event->type() == QEvent::ShortcutOverride) {
        const auto *press = static_cast<QKeyEvent *>(event);
        if (d->control.isFlying() && hasFocus() && isPlain(press) && d->control.isBound(press->key())) {
            event->accept();  // who flies does not open a menu with it
            return true;
        }
    }
    if (event->type() == QEvent::WindowDeactivate)
        d->control.endHold();
    return QPlcWidget::event(event);
}

void QPlcKeyboardControl::keyPressEvent(QKeyEvent *event)
{
    const bool isOurs = hasFocus() && isPlain(event) && d->control.isFlying();
    if (!isOurs || !d->control.press(event->key(), event->isAutoRepeat(), event->nativeScanCode()))
        QPlcWidget::keyPressEvent(event);
}

void QPlcKeyboardControl::keyReleaseEvent(QKeyEvent *event)
{
    if (!d->control.release(event->key(), event->isAutoRepeat(), event->nativeScanCode()))
        QPlcWidget::keyReleaseEvent(event);
}

void QPlcKeyboardControl::mousePressEvent(QMouseEvent *)
{
    setFocus(Qt::MouseFocusReason);
}

void QPlcKeyboardControl::focusInEvent(QFocusEvent *event)
{
    QPlcWidget::focusInEvent(event);
    d->showState();
}

void QPlcKeyboardControl::focusOutEvent(QFocusEvent *event)
{
    d->control.endHold();
    QPlcWidget::focusOutEvent(event);
    d->showState();
}

void QPlcKeyboardControl::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->showValues();
}

void QPlcKeyboardControl::hideEvent(QHideEvent *event)
{
    d->control.endHold();
    QPlcWidget::hideEvent(event);
}

void QPlcKeyboardControl::paintEvent(QPaintEvent *)
{
    if (!d->isInWindow)
        return;
    QPainter painter(this);
    const QPlcTheme theme = context()->theme();
    painter.fillRect(rect(), theme.surface);
    const QPlcSignalControl::State state = d->control.control().state();
    const bool isHeld = state == QPlcSignalControl::Mine || state == QPlcSignalControl::Other;
    if (!isHeld && state != QPlcSignalControl::Lost && !hasFocus())
        return;
    const QColor color = isHeld ? theme.held : state == QPlcSignalControl::Lost ? theme.alarm : theme.accent;
    painter.setPen(QPen(color, isHeld && hasFocus() ? 6.0 : isHeld ? 4.0 : 2.0));
    painter.drawRect(rect());
}
