// SPDX-License-Identifier: Apache-2.0
#include "GaugeFeed.h"

#include "QPlcSignalIndexTable.h"
#include "formulas/Formula.h"
#include "gui/LimitOf.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/DrawNow.h"
#include "gui/panel/FigureFont.h"

#include <QtGui/QGuiApplication>

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

GaugeFeed::GaugeFeed(QObject *parent)
    : QObject(parent)
{
    m_textTimer.setInterval(TextPause);
    connect(&m_textTimer, &QTimer::timeout, this, [this] { refresh(Texts::Renew); });
}

// ---- the signal ----

void GaugeFeed::setContext(QPlcPanelContext *context)
{
    m_context = context;
    connect(context, &QPlcPanelContext::signalsChanged, this, &GaugeFeed::resolve);
    for (const auto change :
         {&QPlcPanelContext::pastChanged, &QPlcPanelContext::timeChanged, &QPlcPanelContext::valuesChanged})
        connect(context, change, this, [this] { refresh(Texts::WhenDue); });
    resolve();
}

void GaugeFeed::setSettings(const GaugeSettings &settings)
{
    const bool isSame = settings.signal == m_settings.signal;
    m_settings = settings;
    m_reference = SignalReference::fromString(settings.signal, &m_referenceError);
    m_alarms.clear();
    m_widest.clear();
    if (isSame && m_context)
        refresh(Texts::Renew);
    else
        resolve();
}

void GaugeFeed::setNameShown(bool isShown)
{
    m_showsName = isShown;
    refresh(Texts::Renew);
}

void GaugeFeed::setActive(bool isActive)
{
    m_isActive = isActive;
    if (!isActive) {
        m_textTimer.stop();
        return;
    }
    m_textTimer.start();
    refresh(Texts::Renew);
}

/// The reference may mean something else now.
void GaugeFeed::resolve()
{
    if (!m_context) {
        lookUp();
        return;
    }
    const QPlcPanelContext::Signal before = m_signal;
    const QPlcPast pastBefore = m_pasts.value(0);
    m_signal = m_context->signal(m_settings.signal);
    m_definition = m_signal ? m_signal.definition : QPlcSignalDefinition();
    const bool isFormula = Formula::isFormula(m_settings.signal);
    if (m_signal && isFormula)
        m_definition.name = m_settings.signal;
    m_pasts.clear();
    const bool isArray = m_definition.type.isArray() && m_signal.element < 0;
    for (int i = 0; i < qBound(1, elements(), MostElements); ++i)
        m_pasts << m_context->past(isArray ? QStringLiteral("%1[%2]").arg(m_settings.signal).arg(i)
                                           : m_settings.signal);
    const QPlcPast &past = m_pasts.constFirst();
    const bool isSame = m_signal.plant == before.plant && m_signal.element == before.element
        && m_signal.definition.name == before.definition.name;
    if (!isSame)
        begin();
    else if (!past || !pastBefore || !past.sharesRows(pastBefore))
        m_seen = 0;
    refresh(Texts::Renew);
}

/// Without a window: in the table of the process.
void GaugeFeed::lookUp()
{
    const QPlcSignalTable table = QPlcSignalIndexTable::current();
    m_definition
        = table.contains(m_reference.signal) ? table.at(table.indexOf(m_reference.signal)) : QPlcSignalDefinition();
    m_value = QPlcValue();
    begin();
    refresh(Texts::Renew);
}

/// Another signal: nothing is known of it yet.
void GaugeFeed::begin()
{
    m_alarms.clear();
    m_widest.clear();
    m_grownScale = GaugeScale();
    m_prefix = SteadyPrefix();
    reset();
}

void GaugeFeed::reset()
{
    m_extremes.fill({noNumber, noNumber}, elements());
    // What is seen at the moment counts. A formula may get its past only now.
    const QPlcPast past = m_pasts.value(0);
    m_seen = past && !past.isEmpty() ? past.endRow() - 1 : 0;
    m_since = past && Formula::isFormula(m_settings.signal) ? past.newestTime() : 0;
    refresh(Texts::Renew);
}

int GaugeFeed::elements() const
{
    if (!m_definition.type.isNumeric())
        return m_definition.type.isValid() ? 1 : 0;
    return m_reference.element == SignalReference::Whole ? m_definition.type.count() : 1;
}

bool GaugeFeed::isBoolean() const
{
    if (m_definition.typeName.startsWith(QLatin1String("Bool"), Qt::CaseInsensitive))
        return true;
    return m_settings.style == GaugeStyle::Led && m_definition.type.isInteger() && limitOf(m_definition.minimum) == 0.0
        && limitOf(m_definition.maximum) == 1.0;
}

GaugeScale GaugeFeed::scale() const
{
    if (isBoolean())
        return {};
    const auto first = [](const std::optional<double> &chosen, const QPlcValue &limit, double grown) {
        return chosen ? *chosen : limitOf(limit).value_or(grown);
    };
    GaugeScale scale{first(m_settings.minimum, m_definition.minimum, m_grownScale.minimum),
                     first(m_settings.maximum, m_definition.maximum, m_grownScale.maximum)};
    if (!(scale.minimum < scale.maximum))
        scale.maximum = scale.minimum + 1.0;
    return scale;
}

/// Beyond the limits of the table is alarm, unless the settings say where it begins.
AlarmLimits GaugeFeed::limits() const
{
    AlarmLimits limits = m_settings.limits;
    if (!limits.alarmLow)
        limits.alarmLow = limitOf(m_definition.minimum);
    if (!limits.alarmHigh)
        limits.alarmHigh = limitOf(m_definition.maximum);
    limits.hysteresis = std::max(0.0, m_settings.hysteresis.value_or(scale().span() * 0.01));
    return limits;
}

// ---- values ----

void GaugeFeed::add(const QList<QPlcSignalList> &batch, QPlcSignalIndex index)
{
    for (const QPlcSignalList &values : batch) {
        const QPlcValue value = values.value(index);
        if (!value.isValid())
            continue;
        m_value = value;
        for (int i = 0; i < elements() && value.type().isNumeric(); ++i) {
            const double number = value.toReal(std::max(i, m_reference.element));
            include(i, number, number);
        }
    }
    refresh(Texts::WhenDue);
}

QPlcValue GaugeFeed::givenValue() const
{
    const int element = m_reference.element;
    return element == SignalReference::Whole || !m_value.isValid() ? m_value : QPlcValue(m_value.toReal(element));
}

void GaugeFeed::include(int element, double minimum, double maximum)
{
    Extremes &extremes = m_extremes[element];
    extremes.minimum = std::fmin(extremes.minimum, minimum);  // NaN counts as nothing
    extremes.maximum = std::fmax(extremes.maximum, maximum);
}

void GaugeFeed::extendExtremes()
{
    if (!m_pasts.value(0) || !m_definition.type.isNumeric())
        return;
    const QPlcPast &rows = m_pasts.constFirst();
    const QPlcPast::Row begin = std::max(m_seen, m_since > 0 ? rows.rowAt(m_since) : rows.firstRow());
    const QPlcPast::Row end = std::max(rows.endRow(), begin);
    for (int i = 0; i < m_pasts.size(); ++i) {
        const QPlcPast::Range range = m_pasts.at(i) ? m_pasts.at(i).range(begin, end) : QPlcPast::Range::empty();
        if (!range.isEmpty())
            include(i, range.minimum, range.maximum);
    }
    m_seen = std::max(rows.endRow(), m_seen);
}

// ---- the picture ----

void GaugeFeed::refresh(Texts texts)
{
    if (!m_isActive)
        return;
    const bool isDue = texts == Texts::Renew || !m_sinceTexts.isValid() || m_sinceTexts.elapsed() >= TextPause;
    if (isDue)
        m_sinceTexts.start();
    GaugePicture picture;
    picture.style = m_settings.style;
    picture.name = m_settings.signal;
    picture.showsName = m_showsName;
    picture.message = missingText();
    if (picture.message.isEmpty())
        showSignal(&picture, isDue);
    show(picture);
}

bool GaugeFeed::eventFilter(QObject *panel, QEvent *event)
{
    if (event->type() == DrawNow::Kind)
        refresh(Texts::Renew);
    return QObject::eventFilter(panel, event);
}

void GaugeFeed::show(const GaugePicture &picture)
{
    if (looksLike(picture, m_picture))
        return;
    m_picture = picture;
    Q_EMIT changed();
}

QString GaugeFeed::missingText() const
{
    if (m_settings.signal.isEmpty())
        return tr("No signal yet.\nDrop one here, or choose one in the settings.");
    const bool isFormula = Formula::isFormula(m_settings.signal);
    if (isFormula && (!m_context || !m_signal))
        return m_context ? m_pasts.value(0).problem : tr("Formulas need a Control Center window.");
    if (!isFormula && !m_reference.isValid())
        return m_referenceError;
    if (m_definition.name.isEmpty())
        return tr("%1\nis not there at the moment. It appears with its plant.").arg(m_settings.signal);
    if (elements() > MostElements)
        return tr("%1 has %2 elements.\nChoose one of them: %1[0]").arg(m_settings.signal).arg(elements());
    return {};
}

void GaugeFeed::showSignal(GaugePicture *picture, bool hasNewTexts)
{
    if (m_context)
        extendExtremes();
    const bool isPast = m_context && m_context->shownTime();
    if (m_context)
        m_signal = m_context->shown(m_settings.signal);
    const QPlcValue value = m_context ? m_signal.value : givenValue();
    picture->isTrusted = value.isValid() && (!m_context || isPast || m_signal.isCurrent);
    picture->isBoolean = isBoolean();
    if (!m_definition.type.isNumeric() || elements() > 1)
        picture->style = GaugeStyle::Number;
    showValue(picture, value, hasNewTexts);
    picture->status = m_context ? m_signal.note : value.isValid() ? QString() : tr("no value yet");
    if (value.isValid() && value.type().isNumeric())
        judge(picture, isPast);
    m_widest = picture->widest;
}

void GaugeFeed::showValue(GaugePicture *picture, const QPlcValue &value, bool hasNewTexts)
{
    const bool isNumeric = m_definition.type.isNumeric();
    for (int i = 0; i < elements(); ++i) {
        GaugePicture::Value shown;
        shown.number = value.isValid() && isNumeric ? value.toReal(i) : noNumber;
        m_grownScale.extendTo(shown.number);
        const Extremes extremes = m_extremes.value(i, {noNumber, noNumber});
        if (m_settings.showsExtremes && !std::isnan(extremes.minimum)) {
            m_grownScale.extendTo(extremes.minimum);
            m_grownScale.extendTo(extremes.maximum);
            shown.minimum = extremes.minimum;
            shown.maximum = extremes.maximum;
        }
        picture->values << shown;
    }
    picture->scale = scale();
    picture->bands = bandsOf(limits(), picture->scale);
    choosePrefix(picture, hasNewTexts);
    showTexts(picture, value, hasNewTexts);
}

/// Of a scale or a range the prefix is always that of its larger end. A number without one has the
/// prefix of its size.
void GaugeFeed::choosePrefix(GaugePicture *picture, bool hasNewTexts)
{
    picture->prefix = SiPrefix(m_definition.unit);
    const bool isQuantity = m_definition.type.isNumeric() && m_definition.valueNames.isEmpty() && !isBoolean();
    const bool hasScale = picture->style == GaugeStyle::Dial || picture->style == GaugeStyle::Bar;
    const bool isOpen = hasOpenEnd() && !hasScale && SiPrefix::isTakenBy(m_definition.unit);
    if (isQuantity && isOpen) {
        double largest = 0.0;
        for (const GaugePicture::Value &value : picture->values)
            largest = std::fmax(largest, std::abs(value.number));  // NaN counts as nothing
        picture->prefix = hasNewTexts || m_prefix.current().tableUnit() != m_definition.unit
            ? m_prefix.next(m_definition.unit, largest)
            : m_prefix.current();
        picture->widestUnit = SiPrefix::fitting(m_definition.unit, 1e5).unit();
    } else if (isQuantity) {
        const double largest = std::max(std::abs(picture->scale.minimum), std::abs(picture->scale.maximum));
        picture->prefix = SiPrefix::fitting(m_definition.unit, largest);
    }
    const bool hasDecimals = m_definition.type.isReal() || picture->prefix.factor() != 1.0;
    picture->isSteady = isOpen && hasDecimals;
    picture->decimals = hasDecimals ? GaugeScale{0.0, picture->prefix.shown(picture->scale.span())}.decimals() : 0;
}

void GaugeFeed::showTexts(GaugePicture *picture, const QPlcValue &value, bool hasNewTexts)
{
    const bool isNumeric = m_definition.type.isNumeric();
    picture->widest = m_widest;
    const QFontMetricsF metrics(figureFont(QGuiApplication::font()));
    const auto widen = [&](const QString &text) {
        if (metrics.horizontalAdvance(text) > metrics.horizontalAdvance(picture->widest))
            picture->widest = text;
    };
    for (const QPlcValueNames::Entry &entry : m_definition.valueNames)
        widen(entry.name);
    if (isNumeric && hasOpenEnd()) {
        picture->sizing = openEndText();
    } else if (isNumeric) {
        widen(valueText(*picture, picture->scale.minimum));
        widen(valueText(*picture, picture->scale.maximum));
    }
    const bool keepsTexts = !hasNewTexts && m_picture.values.size() == picture->values.size()
        && m_picture.prefix.unit() == picture->prefix.unit();
    for (int i = 0; i < picture->values.size(); ++i) {
        GaugePicture::Value &shown = picture->values[i];
        shown.text = keepsTexts ? m_picture.values.at(i).text
            : !value.isValid()  ? noValueText()
            : isNumeric         ? valueText(*picture, shown.number)
                                : qplc::valueText(value);
        widen(shown.text);
    }
}

/// Whether nothing says how large the number may become.
bool GaugeFeed::hasOpenEnd() const
{
    const bool isOpenBelow = !m_settings.minimum && !limitOf(m_definition.minimum);
    const bool isOpenAbove = !m_settings.maximum && !limitOf(m_definition.maximum);
    return (isOpenBelow || isOpenAbove) && !isBoolean() && m_definition.valueNames.isEmpty();
}

/// As wide as a number of an open scale becomes before it gets an exponent, or another prefix: its
/// letters keep their size while it grows.
QString GaugeFeed::openEndText() const
{
    QString text = SiPrefix::isTakenBy(m_definition.unit) ? QStringLiteral("000.00") : QStringLiteral("0000000");
    const QPlcSignalType::Scalar scalar = m_definition.type.scalar();
    const bool isUnsigned = scalar >= QPlcSignalType::UInt8 && scalar <= QPlcSignalType::UInt64;
    const double least = m_settings.minimum ? *m_settings.minimum : limitOf(m_definition.minimum).value_or(-1.0);
    if (least < 0.0 && !isUnsigned)
        text.prepend(minusSign);
    return text;
}

QString GaugeFeed::valueText(const GaugePicture &picture, double number) const
{
    if (!m_definition.valueNames.isEmpty())
        return numberText(number, 6, m_definition.valueNames);
    if (isBoolean())
        return number != 0.0 ? tr("On") : tr("Off");
    return picture.text(number);
}

/// Says what is not normal, in a colour and in words.
void GaugeFeed::judge(GaugePicture *picture, bool isPast)
{
    if (m_alarms.size() != picture->values.size() || isPast
        || (!m_alarms.isEmpty() && m_alarms.first().limits() != limits())) {
        AlarmState state;
        state.setLimits(limits());
        m_alarms.fill(state, picture->values.size());
    }
    QString words;
    const auto say = [&](AlarmState::Level level, const QString &text) {
        if (!words.isEmpty() && level <= picture->level)
            return;
        picture->level = level;
        words = text;
    };
    for (int i = 0; i < picture->values.size(); ++i) {
        const double number = picture->values.at(i).number;
        m_alarms[i].update(number);
        const AlarmState &alarm = m_alarms.at(i);
        const bool isHigh = alarm.side() == AlarmState::High;
        if (std::isnan(number))
            say(AlarmState::Warning, tr("not a number"));
        else if (number > limitOf(m_definition.maximum).value_or(number))
            say(AlarmState::Alarm, tr("▲ over range"));
        else if (number < limitOf(m_definition.minimum).value_or(number))
            say(AlarmState::Alarm, tr("▼ under range"));
        else if (alarm.level() == AlarmState::Alarm)
            say(AlarmState::Alarm, isHigh ? tr("▲▲ high high") : tr("▼▼ low low"));
        else if (alarm.level() == AlarmState::Warning)
            say(AlarmState::Warning, isHigh ? tr("▲ high") : tr("▼ low"));
        else if (number > picture->scale.maximum || number < picture->scale.minimum)
            say(AlarmState::Normal, number > picture->scale.maximum ? tr("▲ off scale") : tr("▼ off scale"));
    }
    if (!words.isEmpty())
        picture->status = picture->status.isEmpty() ? words : words + QStringLiteral(" · ") + picture->status;
}

}  // namespace qplc
