// SPDX-License-Identifier: Apache-2.0
// Runs while an FMU is built, and writes its file.
// Arguments: 2 or 3, PLATFORM, LIBRARY, FILE
#include "FmuVariables.h"
#include "ZipFile.h"

#include <QtCore/QFile>
#include <QtCore/QSaveFile>

#include <cstdio>

using namespace qplc_export;

namespace {

int fail(const QString &text)
{
    std::fprintf(stderr, "%s: %s\n", identity.name, qPrintable(text));
    return 1;
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 5) {
        std::fprintf(stderr, "usage: %s 2|3 PLATFORM LIBRARY FILE\n", argv[0]);
        return 2;
    }
    ExportedNode node;
    QString error;
    if (!node.make(&error))
        return fail(error);
    QFile library(QString::fromLocal8Bit(argv[3]));
    if (!library.open(QIODevice::ReadOnly))
        return fail(QStringLiteral("cannot read %1: %2").arg(library.fileName(), library.errorString()));
    ZipFile zip;
    zip.add("modelDescription.xml", describe(node, *argv[1] == '2' ? Standard::Fmi2 : Standard::Fmi3));
    zip.add("binaries/" + QByteArray(argv[2]) + '/' + QByteArray(identity.name) + ".so", library.readAll());
    zip.add("resources/signals.ini", identity.table);
    QSaveFile file(QString::fromLocal8Bit(argv[4]));
    if (file.open(QIODevice::WriteOnly) && file.write(zip.bytes()) >= 0 && file.commit())
        return 0;
    return fail(QStringLiteral("cannot write %1: %2").arg(file.fileName(), file.errorString()));
}
