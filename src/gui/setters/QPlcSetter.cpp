// SPDX-License-Identifier: Apache-2.0
#include "QPlcSetter.h"
#include "QPlcPanelContext.h"

#include "ControlBar.h"
#include "ElidedLabel.h"
#include "SetterEditor.h"
#include "SetterView.h"
#include "gui/models/ValueFormat.h"

#include <QtCore/QTimer>
#include <QtGui/QPainter>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

struct QPlcSetter::Private
{
    explicit Private(QPlcSetter *setter)
        : q(setter)
        , target(setter->context())
        , name(new ElidedLabel(setter))
        , actual(new ElidedLabel(setter))
        , message(new ElidedLabel(setter))
        , bar(new ControlBar(&target.control(), ControlBar::Small, setter))
    {
        QFont bold = name->font();
        bold.setBold(true);
        name->setFont(bold);
        actual->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        actual->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);  // the name has the rest
        auto *column = new QVBoxLayout(setter);
        column->setContentsMargins(8, 5, 8, 5);
        column->setSpacing(3);
        auto *header = new QHBoxLayout;
        header->addWidget(name, 1);
        header->addWidget(actual);
        column->addLayout(header);
        column->addWidget(message);
        column->addWidget(bar);
        column->addStretch(1);
        constexpr int tenth = 100;  // [ms]
        pause.setSingleShot(true);
        pause.setInterval(tenth);
        connect(&pause, &QTimer::timeout, setter, [this] {
            if (isOutdated)
                showActual();
        });
        connect(&target, &SetterTarget::updated, setter, [this] {
            isOutdated = true;
            if (!pause.isActive())
                showActual();
        });
        connect(&target, &SetterTarget::changed, setter, [this] { showState(); });
        connect(&target.control(), &QPlcSignalControl::leaving, setter, [this] { renewView(); });
    }

    void makeView()
    {
        delete view;  // ends what it does
        view = SetterView::create(settings.style, &target, q);
        static_cast<QVBoxLayout *>(q->layout())->insertWidget(1, view);
        q->setFocusProxy(view);
        connect(view, &SetterView::said, q, [this](const QString &sentence) {
            message->showText(sentence);
            message->setVisible(!sentence.isEmpty());
        });
        connect(view, &SetterView::generatorEdited, q, [this](const QJsonObject &generator) {
            settings.generator = generator;
            Q_EMIT q->settingsEdited();
        });
        message->showText({});
        message->hide();
        view->show();
    }

    /// What was typed or dragged for one plant is not there for the next one.
    void renewView()
    {
        const bool hadFocus = q->isAncestorOf(QApplication::focusWidget());
        makeView();
        view->applySettings(settings.toJson());
        if (hadFocus)
            q->setFocus(Qt::OtherFocusReason);
    }

    void apply(const SetterSettings &wanted)
    {
        const bool isOtherStyle = !view || wanted.style != settings.style;
        const bool isOtherSignal = wanted.signal != settings.signal;
        settings = wanted;
        if (isOtherStyle || isOtherSignal)
            makeView();  // whatever the old one does ends with the signal that it was done to
        if (isOtherSignal)
            target.setSignal(settings.signal.toString());
        target.setLimits(settings.minimum, settings.maximum);
        view->applySettings(settings.toJson());
        showState();
    }

    void showState()
    {
        const SignalReference reference = settings.signal;
        name->showText(reference.isValid() ? reference.toString() : tr("Setter"));
        if (target.signal())
            name->setToolTip(target.signal().definition.description);
        if (view)
            view->refresh();
        showActual();
        q->update();
    }

    void showActual()
    {
        isOutdated = false;
        if (!q->isVisible())
            return;
        pause.start();
        target.renewPrefix();
        actual->showText(actualText());
        if (isInWindow) {
            const bool isStale = target.signal() && target.plant().isStale;
            const QPlcTheme theme = q->context()->theme();
            actual->setColor(isStale ? theme.stale : theme.text);
        }
        view->showActual();
    }

    void showTheme()
    {
        const QPlcTheme theme = q->context()->theme();
        name->setColor(theme.text);
        message->setColor(theme.warning);
        bar->setTheme(theme);
        q->update();
    }

    QString actualText() const
    {
        if (!target.signal())
            return {};
        const QPlcPanelContext::Plant plant = target.plant();
        const QString text = view->actualText();
        return plant.isStale ? tr("%1, %2 old").arg(text, ageText(plant.age)) : text;
    }

    QPlcSetter *const q;
    SetterTarget target;
    SetterSettings settings;
    ElidedLabel *name;
    ElidedLabel *actual;
    SetterView *view = nullptr;
    ElidedLabel *message;
    ControlBar *bar;
    QTimer pause;  // between two looks at the actual value
    bool isOutdated = false;
    bool isInWindow = false;
};

QPlcSetter::QPlcSetter(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    d->makeView();
    d->showState();
    addActions({d->bar->takeAction(), d->bar->giveBackAction()});
    // An age grows also when nothing comes.
    auto *ages = new QTimer(this);
    connect(ages, &QTimer::timeout, this, [this] {
        if (d->target.signal() && d->target.plant().isStale)
            d->showActual();
    });
    ages->start(500);
}

QPlcSetter::~QPlcSetter()
{
    delete d->view;  // ends what it does, while there is something to send it with
}

QJsonObject QPlcSetter::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcSetter::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(SetterSettings::unknownOf(settings));
    d->apply(SetterSettings::fromJson(settings));
}

QWidget *QPlcSetter::createSettingsEditor()
{
    auto *editor = new SetterEditor(d->settings, context());
    connect(editor, &SetterEditor::edited, this, [this](const SetterSettings &settings) {
        d->apply(settings);
        Q_EMIT settingsEdited();
    });
    return editor;
}

bool QPlcSetter::addSignals(const QStringList &references)
{
    for (const QString &text : references) {
        const SignalReference reference = SignalReference::fromString(text);
        if (!reference.isValid())
            continue;
        SetterSettings wanted = d->settings;
        wanted.signal = reference;
        wanted.minimum = wanted.maximum = std::nullopt;  // they were those of another signal
        const QPlcPanelContext::Signal signal = context()->signal(text);
        if (signal && !signal.definition.valueNames.isEmpty() && wanted.style == SetterView::styles().constFirst())
            wanted.style = QStringLiteral("list");
        d->apply(wanted);
        Q_EMIT settingsEdited();
        return true;
    }
    return false;
}

QStringList QPlcSetter::shownSignals() const
{
    return d->settings.signal.isValid() ? QStringList(d->settings.signal.toString()) : QStringList();
}

void QPlcSetter::contextChanged()
{
    d->isInWindow = true;
    connect(context(), &QPlcPanelContext::themeChanged, this, [this] { d->showTheme(); });
    d->showTheme();
}

void QPlcSetter::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->showActual();
}

void QPlcSetter::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    const QPlcSignalControl::State state = d->target.control().state();
    const bool isHeld
        = state == QPlcSignalControl::Mine || state == QPlcSignalControl::Other || state == QPlcSignalControl::Lost;
    if (!d->isInWindow)
        return;
    const QPlcTheme theme = context()->theme();
    painter.fillRect(rect(), theme.surface);
    if (!isHeld)
        return;
    painter.setPen(QPen(state == QPlcSignalControl::Lost ? theme.alarm : theme.held, 4.0));
    painter.drawRect(rect());  // of which 2 px are inside
}
