// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonObject>
#include <QtCore/QJsonValue>
#include <QtCore/QMap>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <chrono>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace qplc::messages {

/// A 64-bit number that travels as a text of 16 hexadecimal digits: JSON numbers are doubles and
/// hold 53 bits.
struct Hex64
{
    quint64 number = 0;

    constexpr Hex64() = default;
    constexpr Hex64(quint64 value)  // NOLINT(google-explicit-constructor): it is that number
        : number(value)
    {
    }
    constexpr operator quint64() const { return number; }  // NOLINT(google-explicit-constructor): likewise
};

/// The texts that an enum has on the wire.
/// To be specialised with `static constexpr std::pair<Enum, const char *> all[]`.
template<typename Enum>
struct Names;

template<typename Enum>
const char *nameOf(Enum value)
{
    for (const auto &[each, name] : Names<Enum>::all) {
        if (each == value)
            return name;
    }
    return "";
}

/// Nothing where no value has this name.
template<typename Enum>
std::optional<Enum> valueNamed(const QString &text)
{
    for (const auto &[each, name] : Names<Enum>::all) {
        if (text == QLatin1String(name))
            return each;
    }
    return std::nullopt;
}

template<typename Struct>
struct WireOfStruct;

/// How a value of type \a T travels: section 3 of docs/protocol.md has the names.
///
/// `fromJson()` returns false, and leaves the value alone, where the JSON is of another type, or
/// there is none.
template<typename T, typename = void>
struct Wire : WireOfStruct<T>
{
};

template<>
struct Wire<QString>
{
    static constexpr const char *name = "text";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const QString &value) { return value; }
    static bool fromJson(const QJsonValue &json, QString *value);
};

template<>
struct Wire<bool>
{
    static constexpr const char *name = "bool";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(bool value) { return value; }
    static bool fromJson(const QJsonValue &json, bool *value);
};

template<>
struct Wire<Hex64>
{
    static constexpr const char *name = "hex64";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(Hex64 value);
    static bool fromJson(const QJsonValue &json, Hex64 *value);
};

template<>
struct Wire<QByteArray>
{
    static constexpr const char *name = "base64";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const QByteArray &value);
    static bool fromJson(const QJsonValue &json, QByteArray *value);
};

template<>
struct Wire<double>
{
    static constexpr const char *name = "number";
    static constexpr bool isNumber = true;
    static QJsonValue toJson(double value) { return value; }
    static bool fromJson(const QJsonValue &json, double *value);
    static double toNumber(double value) { return value; }
};

/// A whole number that \a json is, between the limits; nothing where it is none.
std::optional<double> wholeNumber(const QJsonValue &json, double minimum, double maximum);

template<typename T>
struct Wire<T, std::enable_if_t<std::is_integral_v<T>>>
{
    static constexpr const char *name = "number";
    static constexpr bool isNumber = true;
    static constexpr double largest = sizeof(T) < 8 ? double(std::numeric_limits<T>::max()) : 9007199254740992.0;
    static constexpr double smallest = std::is_signed_v<T> ? -largest : 0.0;
    static QJsonValue toJson(T value) { return double(value); }
    static bool fromJson(const QJsonValue &json, T *value)
    {
        const std::optional<double> number = wholeNumber(json, smallest, largest);
        if (number)
            *value = T(*number);
        return number.has_value();
    }
    static double toNumber(T value) { return double(value); }
};

template<>
struct Wire<std::chrono::nanoseconds>
{
    static constexpr const char *name = "ns";
    static constexpr bool isNumber = true;
    static QJsonValue toJson(std::chrono::nanoseconds value) { return double(value.count()); }
    static bool fromJson(const QJsonValue &json, std::chrono::nanoseconds *value)
    {
        qint64 count = 0;
        const bool is = Wire<qint64>::fromJson(json, &count);
        if (is)
            *value = std::chrono::nanoseconds(count);
        return is;
    }
    static double toNumber(std::chrono::nanoseconds value) { return double(value.count()); }
};

template<typename Enum>
struct Wire<Enum, std::enable_if_t<std::is_enum_v<Enum>>>
{
    static constexpr const char *name = "text";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(Enum value) { return QLatin1String(nameOf(value)); }
    static bool fromJson(const QJsonValue &json, Enum *value)
    {
        const std::optional<Enum> named = json.isString() ? valueNamed<Enum>(json.toString()) : std::nullopt;
        if (named)
            *value = *named;
        return named.has_value();
    }
};

/// A value that may be missing. To be described with Presence::WhenSet.
template<typename T>
struct Wire<std::optional<T>>
{
    static constexpr const char *name = Wire<T>::name;
    static constexpr bool isNumber = Wire<T>::isNumber;
    static QJsonValue toJson(const std::optional<T> &value) { return value ? Wire<T>::toJson(*value) : QJsonValue(); }
    static bool fromJson(const QJsonValue &json, std::optional<T> *value)
    {
        T inner{};
        const bool is = Wire<T>::fromJson(json, &inner);
        if (is)
            *value = std::move(inner);
        return is;
    }
    static double toNumber(const std::optional<T> &value) { return Wire<T>::toNumber(*value); }
};

/// An array; one element that is of another type makes all of it unusable.
template<typename List, typename T>
struct WireOfList
{
    static constexpr const char *name = "array";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const List &list)
    {
        QJsonArray array;
        for (const T &each : list)
            array.append(Wire<T>::toJson(each));
        return array;
    }
    static bool fromJson(const QJsonValue &json, List *list)
    {
        if (!json.isArray())
            return false;
        const QJsonArray array = json.toArray();
        List read;
        read.reserve(array.size());
        for (const QJsonValue &each : array) {
            T element{};
            if (!Wire<T>::fromJson(each, &element))
                return false;
            read.push_back(std::move(element));
        }
        *list = std::move(read);
        return true;
    }
};

template<typename T>
struct Wire<std::vector<T>> : WireOfList<std::vector<T>, T>
{
};
template<typename T>
struct Wire<QVector<T>> : WireOfList<QVector<T>, T>
{
};
template<>
struct Wire<QStringList> : WireOfList<QStringList, QString>
{
};

/// An object whose names are data, such as names of signals.
template<typename T>
struct Wire<QMap<QString, T>>
{
    static constexpr const char *name = "object";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const QMap<QString, T> &map)
    {
        QJsonObject object;
        for (auto each = map.begin(); each != map.end(); ++each)
            object.insert(each.key(), Wire<T>::toJson(each.value()));
        return object;
    }
    static bool fromJson(const QJsonValue &json, QMap<QString, T> *map)
    {
        if (!json.isObject())
            return false;
        const QJsonObject object = json.toObject();
        QMap<QString, T> read;
        for (auto each = object.begin(); each != object.end(); ++each) {
            T value{};
            if (!Wire<T>::fromJson(each.value(), &value))
                return false;
            read.insert(each.key(), std::move(value));
        }
        *map = std::move(read);
        return true;
    }
};

}  // namespace qplc::messages
