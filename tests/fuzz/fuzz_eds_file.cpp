// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/canopen/EdsFile.h"

// Input: an EDS file. Whatever is read without an error can be used.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QVector<QPlcParseError> errors;
    const qplc::EdsFile file = qplc::EdsFile::fromText(text, QStringLiteral("fuzzed.eds"), 5, &errors);
    const QVector<qplc::CanOpenObject> &objects = file.dictionary().objects();
    fuzz::check(objects.isEmpty() != errors.isEmpty(), "a file has objects, or else errors");
    fuzz::check(errors.size() <= qplc::EdsFile::MaximumErrors, "errors have an end");
    fuzz::check(objects.size() <= qplc::EdsFile::MaximumObjects + 255, "objects have an end");
    for (const QPlcParseError &error : errors)
        fuzz::check(!error.toString().isEmpty() && error.line >= 0 && error.column >= 0, "an error has a place");
    for (const qplc::CanOpenObject &object : objects) {
        fuzz::check(file.dictionary().find(object.address) == &object, "each object has its own address");
        fuzz::check(qplc::ObjectAddress::fromText(object.address.toText()) == object.address, "an address is its text");
        const bool fits
            = !object.value || (object.number && (*object.value & ~qplc::RawNumber::lowBits(object.number->bits)) == 0);
        fuzz::check(fits, "a value fits into its object");
    }
    return 0;
}
