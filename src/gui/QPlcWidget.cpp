// SPDX-License-Identifier: Apache-2.0
#include "QPlcWidget.h"

#include "QPlcPanelContext.h"
#include "QPlcWidgetFactory.h"

#include <QtCore/QSet>

#include <algorithm>
#include <vector>

namespace {

std::vector<std::unique_ptr<QPlcWidgetFactory>> &factories()
{
    static std::vector<std::unique_ptr<QPlcWidgetFactory>> all;
    return all;
}

const QString plantKey = QStringLiteral("plant");

template<typename Matches>
QPlcWidgetFactory *findFactory(Matches matches)
{
    const auto found = std::find_if(factories().begin(), factories().end(),
                                    [&](const std::unique_ptr<QPlcWidgetFactory> &each) { return matches(*each); });
    return found != factories().end() ? found->get() : nullptr;
}

}  // namespace

struct QPlcWidget::Private
{
    QString title;
    QString defaultTitle;
    QString pinnedPlant;
    QJsonObject settings;
    QPlcSignalIndexList inputs;
    QPlcSignalIndexList outputs;
    QPlcSignalList initialOutputs;
    std::unique_ptr<QPlcPanelContext> context;
    QSet<QString> ownKeys;  // of setting() and setSetting()
};

QPlcWidget::QPlcWidget(QWidget *parent)
    : QWidget(parent)
    , d(std::make_unique<Private>())
{
    d->context.reset(new QPlcPanelContext(this));
}

QPlcWidget::~QPlcWidget() = default;

QPlcWidgetFactory *QPlcWidget::registerFactory(QPlcWidgetFactory *factory)
{
    const bool isKnown = findFactory([factory](const QPlcWidgetFactory &other) { return &other == factory; });
    if (!isKnown)
        factories().emplace_back(factory);
    return factory;
}

QPlcWidgetFactory *QPlcWidget::factory(int type)
{
    return findFactory([type](const QPlcWidgetFactory &each) { return type != 0 && each.type() == type; });
}

QPlcWidgetFactory *QPlcWidget::factory(const QString &kind)
{
    return findFactory([&kind](const QPlcWidgetFactory &each) { return each.name() == kind; });
}

QPlcWidgetFactory *QPlcWidget::factory() const
{
    return kind().isEmpty() ? factory(type()) : factory(kind());
}

QString QPlcWidget::title() const
{
    if (!d->title.isEmpty())
        return d->title;
    return defaultTitle();
}

QString QPlcWidget::defaultTitle() const
{
    if (!d->defaultTitle.isEmpty())
        return d->defaultTitle;
    const QPlcWidgetFactory *maker = factory();
    return maker ? maker->title() : kind();
}

void QPlcWidget::setDefaultTitle(const QString &title)
{
    if (title == d->defaultTitle)
        return;
    d->defaultTitle = title;
    if (d->title.isEmpty())
        Q_EMIT titleChanged();
}

void QPlcWidget::setTitle(const QString &title)
{
    if (title == d->title)
        return;
    d->title = title;
    Q_EMIT titleChanged();
}

QString QPlcWidget::pinnedPlant() const
{
    return d->pinnedPlant;
}

void QPlcWidget::setPinnedPlant(const QString &plant)
{
    if (plant == d->pinnedPlant)
        return;
    d->pinnedPlant = plant;
    Q_EMIT pinnedPlantChanged();
}

QJsonObject QPlcWidget::settings() const
{
    QJsonObject all = d->settings;
    if (!d->pinnedPlant.isEmpty())
        all.insert(plantKey, d->pinnedPlant);
    if (!d->title.isEmpty())
        all.insert(QStringLiteral("title"), d->title);
    return all;
}

void QPlcWidget::applySettings(const QJsonObject &settings)
{
    setPinnedPlant(settings.value(plantKey).toString());
    for (const QString &key : qAsConst(d->ownKeys))
        d->settings.remove(key);
    for (auto entry = settings.begin(); entry != settings.end(); ++entry) {
        if (entry.key() == QLatin1String("title"))
            setTitle(entry.value().toString());
        else if (entry.key() != plantKey)
            d->settings.insert(entry.key(), entry.value());
    }
    update();
}

QJsonObject QPlcWidget::settingsWith(const QJsonObject &own) const
{
    QJsonObject all = QPlcWidget::settings();
    for (auto entry = own.begin(); entry != own.end(); ++entry)
        all.insert(entry.key(), entry.value());
    return all;
}

QJsonValue QPlcWidget::setting(const QString &key, const QJsonValue &defaultValue) const
{
    d->ownKeys.insert(key);
    const QJsonValue value = d->settings.value(key);
    return value.isUndefined() ? defaultValue : value;
}

void QPlcWidget::setSetting(const QString &key, const QJsonValue &value, const QJsonValue &defaultValue)
{
    d->ownKeys.insert(key);
    const QJsonObject before = d->settings;
    if (value.isNull() || value.isUndefined() || value == defaultValue)
        d->settings.remove(key);
    else
        d->settings.insert(key, value);
    if (d->settings == before)
        return;
    update();
    Q_EMIT settingsEdited();
}

bool QPlcWidget::addSignals(const QStringList & /*references*/)
{
    return false;
}

QPlcPanelContext *QPlcWidget::context() const
{
    return d->context.get();
}

void QPlcWidget::setContext(qplc::WindowContext *context)
{
    d->context->setWindow(context);
    contextChanged();
}

QPlcSignalIndexList QPlcWidget::inputSignalIndices() const
{
    return d->inputs;
}

QPlcSignalIndexList QPlcWidget::outputSignalIndices() const
{
    return d->outputs;
}

QPlcSignalList QPlcWidget::initialOutputSignals() const
{
    return d->initialOutputs;
}

void QPlcWidget::realTimeout(const QList<QPlcSignalList> & /*signalValues*/) {}

void QPlcWidget::setInputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->inputs = indices;
    Q_EMIT inputSignalIndicesChanged();
}

void QPlcWidget::setOutputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->outputs = indices;
    Q_EMIT outputSignalIndicesChanged();
}

void QPlcWidget::setInitialOutputSignals(const QPlcSignalList &signalValues)
{
    d->initialOutputs = signalValues;
    Q_EMIT initialOutputSignalsChanged();
}
