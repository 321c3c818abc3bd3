// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FieldList.h"
#include "Members.h"
#include "Wire.h"

#include <limits>

namespace qplc::messages {

/// Whether a field has to be there.
enum class Presence : quint8 {
    Required,   ///< the message cannot be carried out without it
    Defaulted,  ///< always sent; a receiver that misses it takes the value of the struct
    WhenSet,    ///< sent where it differs from the value of the struct
    Checked     ///< as WhenSet; what is there and cannot be used is an error
};

/// Smallest and largest number that a field may have.
struct Range
{
    double minimum = std::numeric_limits<double>::lowest();
    double maximum = std::numeric_limits<double>::max();
};

/// One field of a message: its name on the wire, and the member of the struct that holds its value.
template<typename Owner, typename Value>
struct Field
{
    using Struct = Owner;
    const char *name;
    Value Owner::*member;
    Presence presence;
    Range range;
};

/// Describes a field. Its type on the wire is that of the member: see Wire.
template<typename Owner, typename Value>
constexpr Field<Owner, Value> field(const char *name, Value Owner::*member, Presence presence = Presence::Defaulted,
                                    Range range = {})
{
    return {name, member, presence, range};
}

/// The fields of \a Struct: its own `fields`, unless this is specialised for a struct that knows
/// nothing of messages.
template<typename Struct>
struct Description
{
    static constexpr auto &fields = Struct::fields;
};

/// The fields of \a Struct. A member that is missing there does not compile.
template<typename Struct>
constexpr const auto &fieldsIn()
{
    constexpr const auto &fields = Description<Struct>::fields;
    static_assert(std::is_aggregate_v<Struct>,
                  "a struct of messages needs public members and no constructor, so that its members can be counted");
    static_assert(areAllMembers<Struct>(&fields), "a member of this struct of messages is missing in its `fields`");
    static_assert(isEachOnce(fields), "two entries in `fields` have the same name, or the same member");
    return fields;
}

// ---- to the wire ----

template<typename Value, typename = void>
struct IsContainer : std::false_type
{
};
template<typename Value>
struct IsContainer<Value, std::void_t<decltype(std::declval<Value>().empty())>> : std::true_type
{
};

template<typename Value>
struct IsOptional : std::false_type
{
};
template<typename Value>
struct IsOptional<std::optional<Value>> : std::true_type
{
};

template<typename Value, typename = void>
struct IsComparable : std::false_type
{
};
template<typename Value>
struct IsComparable<Value, std::void_t<decltype(std::declval<Value>() == std::declval<Value>())>> : std::true_type
{
};

template<typename Value>
bool differs(const Value &value, const Value &unset)
{
    if constexpr (IsContainer<Value>::value && !std::is_same_v<Value, QString>)
        return value.empty() != unset.empty();
    else if constexpr (IsOptional<Value>::value)
        return value.has_value();
    else if constexpr (IsComparable<Value>::value)
        return !(value == unset);
    else
        return true;
}

template<typename Struct, typename Owner, typename Value>
void write(const Struct &value, const Field<Owner, Value> &field, QJsonObject *object)
{
    static const Struct unset;
    const Value &member = value.*field.member;
    const bool isAlwaysSent = field.presence == Presence::Required || field.presence == Presence::Defaulted;
    if (isAlwaysSent || differs(member, unset.*field.member))
        object->insert(QLatin1String(field.name), Wire<Value>::toJson(member));
}

template<typename Struct, typename... Fields>
void write(const Struct &value, const FieldList<Fields...> &fields, QJsonObject *object)
{
    fields.forEach([&](const auto &each) { write(value, each, object); });
}

template<typename Struct>
QJsonObject toObject(const Struct &value)
{
    QJsonObject object;
    write(value, fieldsIn<Struct>(), &object);
    return object;
}

// ---- from the wire ----

/// "field 'every' is 0; it has to be 1 ... 1000000"
QString outOfRangeText(const char *name, double number, Range range);
/// "field 'values' is missing or not of type base64"
QString unusableText(const char *name, const char *type);

template<typename Struct, typename Owner, typename Value>
bool read(const QJsonObject &object, const Field<Owner, Value> &field, Struct *value, QString *error)
{
    Value member{};
    const QJsonValue json = object.value(QLatin1String(field.name));
    if (!Wire<Value>::fromJson(json, &member)) {
        // What is not needed and cannot be used is as if it were not there: a Stop with a bad field
        // stops.
        const bool isNeeded
            = field.presence == Presence::Required || (field.presence == Presence::Checked && !json.isUndefined());
        if (isNeeded)
            *error = unusableText(field.name, Wire<Value>::name);
        return !isNeeded;
    }
    if constexpr (Wire<Value>::isNumber) {
        const double number = Wire<Value>::toNumber(member);
        if (number < field.range.minimum || number > field.range.maximum) {
            *error = outOfRangeText(field.name, number, field.range);
            return false;
        }
    }
    value->*field.member = std::move(member);
    return true;
}

template<typename Struct, typename... Fields>
bool read(const QJsonObject &object, const FieldList<Fields...> &fields, Struct *value, QString *error)
{
    return fields.visit([&](const auto &...each) { return (read(object, each, value, error) && ...); });
}

/// Reads all fields of \a Struct. Fields that it does not know are ignored.
/// \return false when a field that is needed cannot be used: \a error says which one, and \a value
///         is not to be used
template<typename Struct>
bool fromObject(const QJsonObject &object, Struct *value, QString *error)
{
    return read(object, fieldsIn<Struct>(), value, error);
}

// ---- fields of somebody else ----

/// The fields of a message that its struct does not name, for somebody who knows them.
///
/// Writing adds those that no other description has written.
template<typename Owner>
struct Rest
{
    using Struct = Owner;
    static constexpr const char *name = "";
    QJsonObject Owner::*member;
};

template<typename Owner>
constexpr Rest<Owner> rest(QJsonObject Owner::*member)
{
    return {member};
}

template<typename Struct, typename Owner>
void write(const Struct &value, const Rest<Owner> &rest, QJsonObject *object)
{
    const QJsonObject &fields = value.*rest.member;
    for (auto each = fields.begin(); each != fields.end(); ++each) {
        if (!object->contains(each.key()))
            object->insert(each.key(), each.value());
    }
}

template<typename Struct, typename Owner>
bool read(const QJsonObject &object, const Rest<Owner> &rest, Struct *value, QString *)
{
    QJsonObject others = object;
    fieldsIn<Struct>().forEach([&others](const auto &each) { others.remove(QLatin1String(each.name)); });
    value->*rest.member = others;
    return true;
}

/// The fields of \a Struct among those of \a object. What is missing or cannot be used is as in a
/// new struct.
template<typename Struct>
Struct fieldsOf(const QJsonObject &object)
{
    Struct value;
    QString ignored;
    fromObject(object, &value, &ignored);
    return value;
}

/// Adds the fields of \a value to \a object.
template<typename Struct>
void addFields(const Struct &value, QJsonObject *object)
{
    write(value, fieldsIn<Struct>(), object);
}

// ---- structs in structs ----

template<typename Struct>
struct WireOfStruct
{
    static constexpr const char *name = "object";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const Struct &value) { return toObject(value); }
    static bool fromJson(const QJsonValue &json, Struct *value)
    {
        QString error;
        return json.isObject() && fromObject(json.toObject(), value, &error);
    }
};

}  // namespace qplc::messages
