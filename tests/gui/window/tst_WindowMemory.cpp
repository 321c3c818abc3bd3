// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/window/Documentation.h"
#include "gui/window/EventLine.h"
#include "gui/window/WindowSettings.h"

#include <QtWidgets/QFileDialog>
#include <QtWidgets/QTextBrowser>

using namespace qplc;

namespace {

void write(const QString &fileName, const QByteArray &text)
{
    QFile file(fileName);
    QVERIFY(QDir().mkpath(QFileInfo(fileName).path()) && file.open(QIODevice::WriteOnly));
    file.write(text);
}

}  // namespace

/// What the window keeps, and what it says of itself: settings, layouts that are saved, documents,
/// version and licences.
class tst_WindowMemory : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void settingsHaveTheFolderOfTheOrganization();
    void settingsOfUnknownOrganizationAreMigratedOnce();
    void namedOrganizationMigratesNoSettings();
    void eventLineShowsTheSavedFile();
    void documentsAreFoundWhereTheyAreInstalledAndInTheSourceTree();
    void helpShowsTheDocuments();
    void helpShowsVersionAndLicences();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_WindowMemory::settingsHaveTheFolderOfTheOrganization()
{
    WindowSettings settings;
    QCOMPARE(settings.organizationName(), QStringLiteral("QtPlcTest"));
    QCOMPARE(settings.fileName(), QSettings().fileName());
    QCoreApplication::setOrganizationName({});
    QCOMPARE(WindowSettings().organizationName(), QStringLiteral("QtPLC"));
    QVERIFY(!WindowSettings().fileName().contains(QLatin1String("Unknown")));
}

void tst_WindowMemory::settingsOfUnknownOrganizationAreMigratedOnce()
{
    QCoreApplication::setOrganizationName({});
    {
        QSettings former;  // as windows of programs without an organization had them
        former.setValue(QStringLiteral("ControlCenter/theme"), QStringLiteral("Sunlight"));
        former.setValue(QStringLiteral("Other/thing"), 1);
    }
    QVERIFY(QSettings().fileName().contains(QLatin1String("Unknown Organization")));
    QCOMPARE(WindowSettings().value(QStringLiteral("ControlCenter/theme")).toString(), QStringLiteral("Sunlight"));
    QVERIFY(!WindowSettings().contains(QStringLiteral("Other/thing")));
    // From then on they have a life of their own.
    WindowSettings().setValue(QStringLiteral("ControlCenter/theme"), QStringLiteral("Dark"));
    QSettings().setValue(QStringLiteral("ControlCenter/theme"), QStringLiteral("Light"));
    QCOMPARE(WindowSettings().value(QStringLiteral("ControlCenter/theme")).toString(), QStringLiteral("Dark"));
}

void tst_WindowMemory::namedOrganizationMigratesNoSettings()
{
    QCoreApplication::setOrganizationName({});
    QSettings().setValue(QStringLiteral("ControlCenter/theme"), QStringLiteral("Sunlight"));
    QCoreApplication::setOrganizationName(QStringLiteral("Somebody"));
    QVERIFY(!WindowSettings().contains(QStringLiteral("ControlCenter/theme")));
}

void tst_WindowMemory::eventLineShowsTheSavedFile()
{
    QTemporaryDir folder;
    const QString fileName = folder.filePath(QStringLiteral("mine.json"));
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QVERIFY(fixture.window.saveLayout(fileName));  // from here on Ctrl+S knows the file
    QVERIFY(QFile::remove(fileName));
    fixture.press(Qt::Key_S, Qt::ControlModifier);
    QVERIFY(QFile::exists(fileName));
    auto *line = fixture.part<EventLine>();
    QVERIFY2(line->text().contains(QStringLiteral("Layout saved: ") + fileName), qPrintable(line->text()));
    QTRY_VERIFY(line->text().startsWith(QLatin1String("No events")));
    // An event that asks is seen at once.
    fixture.press(Qt::Key_S, Qt::ControlModifier);
    fixture.window.context()->events()->append({QDateTime::currentDateTime(), PlantEvent::Error, QStringLiteral("kite"),
                                                QStringLiteral("tether broken"), false});
    QVERIFY2(line->text().contains(QLatin1String("tether broken")), qPrintable(line->text()));
}

void tst_WindowMemory::documentsAreFoundWhereTheyAreInstalledAndInTheSourceTree()
{
    QTemporaryDir folder;
    const auto at = [&](const char *path) { return folder.filePath(QString::fromLatin1(path)); };
    QCOMPARE(documentationFolder({at("prefix/bin")}), QString());
    write(at("prefix/share/doc/QtPlc/docs/control-center.md"), "# Installed");
    write(at("tree/docs/control-center.md"), "# Sources");
    QDir(folder.path()).mkpath(QStringLiteral("prefix/lib/x86_64-linux-gnu"));
    QDir(folder.path()).mkpath(QStringLiteral("tree/build/dev/src/gui"));
    QCOMPARE(documentationFolder({at("prefix/lib/x86_64-linux-gnu")}), at("prefix/share/doc/QtPlc/docs"));
    QCOMPARE(documentationFolder({at("nowhere"), at("prefix/bin")}), at("prefix/share/doc/QtPlc/docs"));
    QCOMPARE(documentationFolder({at("tree/build/dev/src/gui")}), at("tree/docs"));
    QVERIFY2(!documentationFolder(documentationStarts()).isEmpty(), "this test is in a build tree");
}

void tst_WindowMemory::helpShowsTheDocuments()
{
    WindowFixture fixture;
    fixture.action("Documentation")->trigger();
    auto *help = fixture.part<HelpWindow>();
    QTRY_VERIFY(help->isVisible());
    QVERIFY(help->browser()->toPlainText().startsWith(QLatin1String("The Control Center")));
    Q_EMIT help->browser()->anchorClicked(QUrl(QStringLiteral("howto/security.md")));
    QVERIFY(help->browser()->source().path().endsWith(QLatin1String("howto/security.md")));
    help->browser()->backward();
    QVERIFY(help->browser()->toPlainText().startsWith(QLatin1String("The Control Center")));
}

void tst_WindowMemory::helpShowsVersionAndLicences()
{
    WindowFixture fixture;
    fixture.action("Version and licences")->trigger();
    auto *about = fixture.part<AboutWindow>();
    QTRY_VERIFY(about->isVisible());
    const QString text = AboutWindow::text();
    for (const char *word : {"QtPLC", "Apache-2.0", "Qt 5", "LGPL-3.0", "Qwt", "muParser", "libsodium", "Eigen"})
        QVERIFY2(text.contains(QLatin1String(word)), word);
    QVERIFY(text.contains(QRegularExpression(QStringLiteral("QtPLC \\d+\\.\\d+\\.\\d+"))));
    Q_EMIT about->licencesRequested();
    QTRY_VERIFY(fixture.part<HelpWindow>()->isVisible());
    QVERIFY(fixture.part<HelpWindow>()->browser()->toPlainText().startsWith(QLatin1String("Licences")));
}

QTEST_MAIN(tst_WindowMemory)
#include "tst_WindowMemory.moc"
