// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "signals/PayloadLayout.h"
#include "signals/ProcessImage.h"

#include <vector>

namespace qplc {

// Which values are in force where nobody's are believed: for a safe stop of the master, and for the
// outputs of a node in its safe state. Both are QPlcSignalDefinition::safeValue(), and their
// quality is Safe.

/// The safe values of \a layout as a frame has them, with their qualities where it has these.
std::vector<char> safeFrame(const QPlcSignalTable &table, const PayloadLayout &layout);

/// The safe values of some signals, ready to be copied over a process image: without an allocation,
/// as few copies as can be.
class SafeImage
{
public:
    SafeImage() = default;
    /// \param image  whose layout is meant
    /// \param wanted  by index; those behind its end are not
    SafeImage(const ProcessImage &image, const std::vector<bool> &wanted);

    /// \param bytes  of a process image of the same table
    void applyTo(char *bytes) const noexcept;
    /// Of a whole image, of use where values are wanted.
    const char *data() const noexcept { return m_bytes.data(); }

private:
    void add(quint32 offset, quint32 size);

    std::vector<char> m_bytes;  // of a whole image
    std::vector<CopyRun> m_runs;
};

}  // namespace qplc
