// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtPlcGui>
#include <QtTest/QtTest>

namespace {

const QString fileName = QStringLiteral(AWE_LAYOUTS "/airborne_wind_energy.json");

QByteArray layoutText()
{
    QFile file(fileName);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// All texts below \a value whose key says that they name a signal.
QStringList signalTexts(const QJsonValue &value, const QString &key = QString())
{
    static const QStringList keys{QStringLiteral("signal"), QStringLiteral("x"), QStringLiteral("y")};
    if (value.isString())
        return keys.contains(key) ? QStringList{value.toString()} : QStringList();
    QStringList all;
    for (const QJsonValue &each : value.toArray())
        all += signalTexts(each, key);
    const QJsonObject object = value.toObject();
    for (auto entry = object.begin(); entry != object.end(); ++entry)
        all += signalTexts(entry.value(), entry.key());
    return all;
}

}  // namespace

/// The layout that comes with awe_control_center.
class tst_BuiltInLayout : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layoutIsTakenAndShown();
    void layoutIsWrittenAsItIsShown();
    void everySignalIsInTheTable();
};

void tst_BuiltInLayout::layoutIsTakenAndShown()
{
    QPlcControlCenter window;
    QString error;
    QVERIFY2(window.addLayout(QStringLiteral("built in"), layoutText(), &error), qPrintable(error));
    for (const char *tab : {"Fly", "Ground station", "Real time"})
        QVERIFY2(window.showTab(QString::fromLatin1(tab)), tab);
    QVERIFY(!window.showTab(QStringLiteral("Kitchen")));
}

void tst_BuiltInLayout::layoutIsWrittenAsItIsShown()
{
    QPlcControlCenter window;
    QVERIFY(window.openLayout(fileName));
    QTemporaryDir folder;
    const QString copy = folder.filePath(QStringLiteral("copy.json"));
    QVERIFY(window.saveLayout(copy));
    QFile file(copy);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(QJsonDocument::fromJson(file.readAll()), QJsonDocument::fromJson(layoutText()));
}

void tst_BuiltInLayout::everySignalIsInTheTable()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIniFile(awe::builtInSignals());
    QVERIFY(table.size() > 0);
    const QStringList texts = signalTexts(QJsonDocument::fromJson(layoutText()).object());
    QVERIFY(texts.size() > 15);
    static const QRegularExpression name(QStringLiteral("\\b[A-Za-z_]\\w*(?!\\w*\\()"));
    for (const QString &text : texts) {
        QRegularExpressionMatchIterator names = name.globalMatch(text);
        QVERIFY2(names.hasNext(), qPrintable(text));
        while (names.hasNext()) {
            const QString signal = names.next().captured();
            QVERIFY2(table.contains(signal), qPrintable(text));
        }
    }
}

QTEST_MAIN(tst_BuiltInLayout)
#include "tst_BuiltInLayout.moc"
