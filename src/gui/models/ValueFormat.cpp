// SPDX-License-Identifier: Apache-2.0
#include "ValueFormat.h"

#include "node/state/StateText.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtGui/QGuiApplication>
#include <QtGui/QPalette>

#include <cmath>

namespace qplc {

std::unique_ptr<QMimeData> mimeDataOf(const QVector<SignalReference> &references)
{
    QJsonArray texts;
    for (const SignalReference &reference : references)
        texts.append(reference.toString());
    auto mimeData = std::make_unique<QMimeData>();
    mimeData->setData(signalsMimeType(), QJsonDocument(texts).toJson(QJsonDocument::Compact));
    return mimeData;
}

QVector<SignalReference> referencesIn(const QMimeData *mimeData)
{
    QVector<SignalReference> references;
    const QJsonArray texts = QJsonDocument::fromJson(mimeData->data(signalsMimeType())).array();
    for (const QJsonValue &text : texts) {
        const SignalReference reference = SignalReference::fromString(text.toString());
        if (reference.isValid())
            references.append(reference);
    }
    return references;
}

QString numberText(double value, int digits)
{
    return std::isnan(value) ? QStringLiteral("–") : QString::number(value, 'g', digits);
}

QString numberText(double value, int digits, const QPlcValueNames &names)
{
    const bool isInteger = !names.isEmpty() && std::abs(value) < 1e15 && std::floor(value) == value;
    const QString name = isInteger ? names.nameOf(qint64(value)) : QString();
    return name.isEmpty() ? numberText(value, digits) : name;
}

namespace {

QString timeText(const QPlcValue &value)
{
    return value.toDateTime().toLocalTime().toString(QStringLiteral("HH:mm:ss.zzz"));
}

/// Exponents only where there is no other way.
QString wholeNumberText(double value, int digits)
{
    const double size = std::abs(value);
    return size >= 1.0 && size < 1e6 ? numberText(value, std::max(digits, int(std::log10(size)) + 1))
                                     : numberText(value, digits);
}

QString fittingNumberText(double value)
{
    constexpr int mostCharacters = 9;
    int digits = 6;
    while (digits > 3 && wholeNumberText(value, digits).size() > mostCharacters)
        --digits;
    return wholeNumberText(value, digits);
}

template<typename ToText>
QString elementsText(const QPlcValue &value, const ToText &toText)
{
    constexpr int mostElements = 16;  // a line is not for matrices
    const QPlcSignalType type = value.type();
    QStringList elements;
    for (int i = 0; i < std::min(type.count(), mostElements); ++i)
        elements << toText(value.toReal(i));
    if (type.count() > mostElements)
        elements << QStringLiteral("… %1 elements").arg(type.count());
    return QStringLiteral("[%1]").arg(elements.join(QStringLiteral(", ")));
}

}  // namespace

QString valueText(const QPlcValue &value)
{
    const QPlcSignalType type = value.type();
    if (type.isDateTime())
        return timeText(value);
    if (!type.isReal())
        return type.isArray() ? QStringLiteral("[%1]").arg(value.toString()) : value.toString();
    const int digits = type.scalar() == QPlcSignalType::Real32 ? 7 : 10;
    return type.isArray() ? elementsText(value, [digits](double element) { return numberText(element, digits); })
                          : numberText(value.toReal(), digits);
}

namespace {

QString namedText(const QPlcValue &value, const QPlcSignalDefinition &definition)
{
    const QString text = definition.textOf(value);
    return value.type().isArray() ? QStringLiteral("[%1]").arg(text) : text;
}

}  // namespace

QString valueText(const QPlcValue &value, const QPlcSignalDefinition &definition)
{
    return definition.valueNames.isEmpty() ? valueText(value) : namedText(value, definition);
}

QString shortValueText(const QPlcValue &value, const QPlcSignalDefinition &definition)
{
    return definition.valueNames.isEmpty() ? shortValueText(value) : namedText(value, definition);
}

QString shortValueText(const QPlcValue &value)
{
    const QPlcSignalType type = value.type();
    if (type.isDateTime())
        return value.isValid() ? timeText(value).chopped(2) : QString();
    if (!type.isReal())
        return valueText(value);
    return type.isArray() ? elementsText(value, [](double element) { return wholeNumberText(element, 3); })
                          : fittingNumberText(value.toReal());
}

QString ageText(double seconds)
{
    if (seconds < 0.0)
        return {};
    if (seconds < 0.1)
        return QStringLiteral("< 0.1 s");
    if (seconds < 60.0)
        return QStringLiteral("%1 s").arg(seconds, 0, 'f', 1);
    if (seconds < 3600.0)
        return QStringLiteral("%1 min").arg(std::floor(seconds / 60.0));
    return QStringLiteral("%1 h").arg(std::floor(seconds / 3600.0));
}

QString durationText(double nanoseconds)
{
    const double size = std::abs(nanoseconds);
    if (size < 999.5e3)
        return QStringLiteral("%1 µs").arg(QString::number(nanoseconds * 1e-3, 'g', 3));
    if (size < 999.5e6)
        return QStringLiteral("%1 ms").arg(QString::number(nanoseconds * 1e-6, 'g', 3));
    return QStringLiteral("%1 s").arg(QString::number(nanoseconds * 1e-9, 'g', 4));
}

QString qualityText(Plant::Quality quality)
{
    switch (quality) {
    case Plant::NoValue:
        return QCoreApplication::translate("ValueFormat", "no value");
    case Plant::Good:
        return QCoreApplication::translate("ValueFormat", "good");
    case Plant::AtRest:
        return QCoreApplication::translate("ValueFormat", "at rest");
    case Plant::Stale:
        return QCoreApplication::translate("ValueFormat", "stale");
    }
    return {};
}

QString qualityText(const PlantList::Signal &signal)
{
    const Plant::Quality ofPlant = signal.plant->quality();
    const QPlcQuality quality = signal.quality();
    switch (ofPlant == Plant::Good ? quality.kind() : QPlcQuality::Good) {  // at rest no value is of now
    case QPlcQuality::Good:
        break;
    case QPlcQuality::Held:
        return QCoreApplication::translate("ValueFormat", "held %1").arg(quality.heldCycles());
    case QPlcQuality::Safe:
        return QCoreApplication::translate("ValueFormat", "safe");
    case QPlcQuality::Invalid:
        return QCoreApplication::translate("ValueFormat", "not written");
    }
    return qualityText(ofPlant);
}

bool isTrusted(const PlantList::Signal &signal)
{
    const Plant::Quality ofPlant = signal.plant->quality();
    return ofPlant == Plant::AtRest || (ofPlant == Plant::Good && signal.quality().isUsable());
}

QString stateWord(const Plant &plant)
{
    switch (plant.connectionState()) {
    case PlantConnection::Connected:
        return stateText(plant.status().master.state);
    case PlantConnection::Connecting:
        return QCoreApplication::translate("ValueFormat", "connecting");
    case PlantConnection::Disconnected:
        break;
    }
    if (plant.recording())
        return QCoreApplication::translate("ValueFormat", "recording");
    return plant.store() ? QCoreApplication::translate("ValueFormat", "lost")
                         : QCoreApplication::translate("ValueFormat", "not there");
}

QVariant foregroundOf(bool isTrusted)
{
    return isTrusted ? QVariant() : QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text);
}

}  // namespace qplc
