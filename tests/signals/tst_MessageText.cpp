// SPDX-License-Identifier: Apache-2.0
#include "signals/MessageText.h"

#include <QtTest/QtTest>

// What somebody else has written, before people see it.
class tst_MessageText : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void textsAreSanitizedForDisplay_data();
    void textsAreSanitizedForDisplay();
    void longTextIsSanitizedInLinearTime();
};

void tst_MessageText::textsAreSanitizedForDisplay_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("shown");
    const auto row
        = [](const char *name, const QString &text, const QString &shown) { QTest::newRow(name) << text << shown; };
    const QString kite = QString::fromUtf8("\xF0\x9F\xAA\x81");
    row("nothing", {}, {});
    row("plain", QStringLiteral(u"Höhenwind 3 m/s² 東"), QStringLiteral(u"Höhenwind 3 m/s² 東"));
    row("a pair of surrogates", kite, kite);
    row("commands of a terminal", QStringLiteral("a\x1b[2Jb\x07\x9b"), QStringLiteral("a?[2Jb??"));
    row("lines", QStringLiteral("one\ntwo\r"), QStringLiteral("one?two?"));
    row("line and paragraph of Unicode", QStringLiteral(u"a\u2028b\u2029c"), QStringLiteral("a?b?c"));
    row("turned text", QStringLiteral(u"kite\u202Eelbisivni\u2066"), QStringLiteral("kite?elbisivni?"));
    row("hidden text", QStringLiteral(u"ad\u200Bmin\uFEFF"), QStringLiteral("ad?min?"));
    row("hidden text beyond 16 bits", QStringLiteral(u"a\U000E0041b"), QStringLiteral("a?b"));
    row("one's own characters", QStringLiteral(u"a\uE000b\U0010FFFD"), QStringLiteral("a?b?"));
    row("no character", QStringLiteral(u"a\uFFFFb"), QStringLiteral("a?b"));
    row("half a pair", QString(QChar(0xD83E)), QStringLiteral("?"));
    row("the other half", QChar(0xDE81) + QStringLiteral("a"), QStringLiteral("?a"));
    row("halves in the wrong order", QString(QChar(0xDE81)) + QChar(0xD83E), QStringLiteral("??"));
}

void tst_MessageText::textsAreSanitizedForDisplay()
{
    QFETCH(QString, text);
    QFETCH(QString, shown);
    QCOMPARE(qplc::printable(text), shown);
    QCOMPARE(qplc::quoted(text), QLatin1Char('\'') + shown + QLatin1Char('\''));
}

void tst_MessageText::longTextIsSanitizedInLinearTime()
{
    const QString pair = QStringLiteral(u"\U000E0041");
    QCOMPARE(qplc::printable(pair.repeated(1'000'000)), QString(1'000'000, QLatin1Char('?')));
}

QTEST_APPLESS_MAIN(tst_MessageText)
#include "tst_MessageText.moc"
