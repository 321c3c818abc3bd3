// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "models/FmuDescription.h"
#include "models/FmuWiring.h"

using qplc::FmuDescription;
using qplc::FmuElement;
using qplc::FmuVariable;

namespace {

void checkVariable(const FmuDescription &description, const FmuVariable &variable)
{
    fuzz::check(description.find(variable.name) == &variable, "each variable has its own name");
    qint64 count = 1;
    for (int size : variable.dimensions)
        count *= size;
    fuzz::check(variable.count == count && count <= FmuDescription::MostElements, "its dimensions give its elements");
    fuzz::check(!variable.isNumber() || QPlcSignalType(variable.scalar(description.version)).isNumeric(),
                "a number can be part of a signal");
    fuzz::check(!variable.typeText(description.version).isEmpty(), "its type has a name");
}

// Names that are offered stand for numbers.
void checkNames(const FmuDescription &description)
{
    const qplc::FmuWiring wiring(description);
    for (const QString &name : wiring.names()) {
        QString error;
        const QVector<FmuElement> elements = wiring.find(name, &error);
        fuzz::check(!elements.isEmpty() && error.isEmpty(), "a name that is offered stands for something");
        for (const FmuElement &element : elements)
            fuzz::check(element.variable->isNumber() && element.element < element.variable->count,
                        "an element lies in its variable");
    }
}

}  // namespace

// Input: a modelDescription.xml. Whatever is read without an error can be used.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QPlcParseError error;
    const FmuDescription description = FmuDescription::fromXml(text, &error);
    fuzz::check(description.isValid() == error.message.isEmpty(), "a description is valid, or else there is an error");
    if (!description.isValid()) {
        fuzz::check(error.line >= 0 && error.column >= 0, "an error has a place");
        return 0;
    }
    for (const FmuVariable &variable : description.variables)
        checkVariable(description, variable);
    checkNames(description);
    return 0;
}
