// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcParseError.h"
#include "QPlcProfile.h"

#include <QtCore/QByteArray>
#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <chrono>

/// The manifest of a plant: the nodes that it needs, and what each of them has to be.
///
/// \code
/// QVector<QPlcParseError> errors;
/// const QPlcManifest manifest = QPlcManifest::fromIniFile("manifest.ini", &errors);
/// if (!errors.isEmpty())
///     qWarning("%s", qPrintable(QPlcParseError::toString(errors)));
/// QPlcMasterNode master;
/// master.setManifest(manifest);
/// \endcode
///
/// A manifest is an INI text. The section of a node has its name. All keys are optional:
///
/// ```ini
/// profile = Plant                     ; of the plant; default Automatic
///
/// [EmergencyStop]
/// need = critical                     ; critical, required (default) or optional
/// transport = udp, tcp                ; transports that the node may use; default any
/// watchdog = 500 ms                   ; longest that it may have; default any, or none
/// identity = EmergencyStop            ; identity that the node has to prove; default any
/// ```
///
/// A master with a manifest neither initializes nor starts the plant while a critical or required
/// node is missing (QPlcMasterNode::setManifest()). docs/howto/manifest.md shows how to make one.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup master
struct QTPLC_EXPORT QPlcManifest
{
    /// How much the plant needs a node.
    enum Need : quint8 {
        Optional,  ///< the plant may start without it
        Required,  ///< the plant does not start without it, and keeps running when it is lost
        Critical   ///< the plant does not start without it, and stops safely when it is lost
    };
    /// What the manifest says of a node.
    struct Node
    {
        QString name;            ///< name under which the node registers
        Need need = Required;    ///< how much the plant needs it
        QStringList transports;  ///< names of transports that it may use; empty: any
        /// Longest watchdog that it may have; 0: any, or none. Only a watchdog that leads to the
        /// safe state counts.
        std::chrono::nanoseconds watchdog{0};
        QString identity;  ///< identity that it has to prove (QPlcSecurity); empty: any
    };

    QString fileName;                                     ///< for messages; may be empty
    QPlcProfile::Value profile = QPlcProfile::Automatic;  ///< of the plant; Automatic: Plant
    QVector<Node> nodes;                                  ///< in the order of the text

    /// Returns true if there is no node: a master then has no manifest.
    bool isEmpty() const { return nodes.isEmpty(); }
    /// Returns the node \a name; nullptr if the manifest does not name it.
    const Node *find(const QString &name) const;

    /// Reads a manifest. A manifest needs at least one node.
    /// \param text  INI in UTF-8
    /// \param errors  gets all errors, in the order of the text; empty: there were none
    /// \param fileName  for messages
    /// \return an empty manifest if there were errors
    static QPlcManifest fromIni(const QByteArray &text, QVector<QPlcParseError> *errors = nullptr,
                                const QString &fileName = QString());
    /// Reads a manifest from a file, as fromIni() does.
    static QPlcManifest fromIniFile(const QString &fileName, QVector<QPlcParseError> *errors = nullptr);
    /// Returns a text that fromIni() reads as the same manifest.
    /// \pre the names of the nodes contain no `]`, and there is at least one node
    QByteArray toIni() const;

    /// Returns "critical", "required" or "optional", as manifests have them.
    static QString needName(Need need);
};

Q_DECLARE_METATYPE(QPlcManifest)
