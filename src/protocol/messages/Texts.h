// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"

namespace qplc::messages {

template<typename Value, typename Change>
void changeTexts(Value *value, const Change &change);

template<typename Struct, typename Owner, typename Value, typename Change>
void changeTextsOf(Struct *value, const Field<Owner, Value> &field, const Change &change)
{
    changeTexts(&(value->*field.member), change);
}

/// Calls \a change with a pointer to each text of \a value, also of structs, lists and maps in it.
template<typename Value, typename Change>
void changeTexts(Value *value, const Change &change)
{
    if constexpr (std::is_same_v<Value, QString>) {
        change(value);
    } else if constexpr (IsOptional<Value>::value) {
        if (value->has_value())
            changeTexts(&**value, change);
    } else if constexpr (std::is_base_of_v<WireOfStruct<Value>, Wire<Value>>) {
        fieldsIn<Value>().forEach([&](const auto &each) { changeTextsOf(value, each, change); });
    } else if constexpr (IsContainer<Value>::value) {
        for (auto &each : *value)
            changeTexts(&each, change);
    }
}

}  // namespace qplc::messages
