// SPDX-License-Identifier: Apache-2.0
// Runs while an FMU is built: writes its modelDescription.xml. Arguments: 2 or 3, and the file.
#include "FmuVariables.h"

#include <QtCore/QSaveFile>

#include <cstdio>

int main(int argc, char **argv)
{
    using namespace qplc_export;
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s 2|3 FILE\n", argv[0]);
        return 2;
    }
    ExportedNode node;
    QString error;
    if (!node.make(&error)) {
        std::fprintf(stderr, "%s: %s\n", identity.name, qPrintable(error));
        return 1;
    }
    const QByteArray text = describe(node, *argv[1] == '2' ? Standard::Fmi2 : Standard::Fmi3);
    QSaveFile file(QString::fromLocal8Bit(argv[2]));
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
        return 0;
    std::fprintf(stderr, "%s: cannot write %s: %s\n", identity.name, argv[2], qPrintable(file.errorString()));
    return 1;
}
