// SPDX-License-Identifier: Apache-2.0
#include "ProcessPlant.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

/// A master that may have too little memory, as `ulimit -v` says.
class tst_MemoryLimits : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void tableThatNeedsTooMuchIsNamed();
    void everyLimitGivesAMasterOrAMessage();

private:
    /// \param megabytes  of addresses
    std::unique_ptr<Program> master(int megabytes) const
    {
        const QString script = QStringLiteral("ulimit -v %1 && exec '%2' --port=0 --events=none --signals='%3'")
                                   .arg(megabytes * 1000)
                                   .arg(programPath("awe_master"), m_table);
        return std::make_unique<Program>(QStringLiteral("sh"), QStringList{"-c", script});
    }
    /// \return what it says before it ends with exit code 1; empty: it listens
    QString failure(int megabytes) const
    {
        const std::unique_ptr<Program> program = master(megabytes);
        if (program->waitForOutput(QStringLiteral("port ")))
            return {};
        const int exitCode = program->waitForEnd();
        return exitCode == 1 && !program->errors().isEmpty()
            ? program->errors()
            : QStringLiteral("exit code %1: %2").arg(exitCode).arg(program->errors());
    }

    QTemporaryDir m_folder;
    QString m_table;
};

/// A table as large as one may be: the program itself needs less.
void tst_MemoryLimits::initTestCase()
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    QSKIP("a sanitizer takes all addresses that there are");
#endif
    m_table = m_folder.filePath(QStringLiteral("large.ini"));
    QFile file(QStringLiteral(QTPLC_SIGNALS));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QByteArray text = file.readAll() + '\n';
    for (int i = 0; i < 60'000; ++i)
        text += "[s" + QByteArray::number(i) + "]\ntype = Real64[16]\ndescription = " + QByteArray(60, 'x') + "\n";
    QFile table(m_table);
    QVERIFY(table.open(QIODevice::WriteOnly) && table.write(text) == text.size());
}

void tst_MemoryLimits::tableThatNeedsTooMuchIsNamed()
{
    const QString text = failure(100);
    QVERIFY2(text.startsWith(QStringLiteral("awe_master: out of memory for the ")), qPrintable(text));
    QVERIFY2(text.contains(QRegularExpression(QStringLiteral("which needs at least \\d+ bytes; the program has \\d+ MB"
                                                             " of addresses, and may have \\d+ MB; raise the limit")))
                 && text.endsWith(QStringLiteral("or use a table with fewer signals\n")),
             qPrintable(text));
}

void tst_MemoryLimits::everyLimitGivesAMasterOrAMessage()
{
    int megabytes = 90;
    for (QString text = failure(megabytes); !text.isEmpty(); text = failure(megabytes)) {
        QVERIFY2(text.contains(QStringLiteral("memory")), qPrintable(QString::number(megabytes) + ": " + text));
        megabytes += 20;
        QVERIFY(megabytes < 2000);
    }
    QVERIFY(megabytes > 90);
}

QTEST_GUILESS_MAIN(tst_MemoryLimits)
#include "tst_MemoryLimits.moc"
