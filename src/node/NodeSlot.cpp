// SPDX-License-Identifier: Apache-2.0
#include "NodeSlot.h"

#include "QSplitPrimitive.h"

#include <cmath>

namespace qplc {

namespace {

std::size_t sizeOfOutputFrame(const void *decoder, const char *header)
{
    return static_cast<const FrameDecoder *>(decoder)->frameSize(header);
}

template<typename Real>
bool allFinite(const char *bytes, int count) noexcept
{
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(QSplitPrimitive<Real>::fromBytes(bytes + sizeof(Real) * i)))
            return false;
    }
    return true;
}

}  // namespace

void NodeSlot::prepare(const ProcessImage &image, quint64 session)
{
    inputRuns = image.gatherRuns(inputLayout);
    outputRuns = image.scatterRuns(outputLayout);
    sameCycleRuns = image.gatherRuns(inputLayout, sameCycle);
    inputs.assign(inputLayout.size(), 0);
    encoder = FrameEncoder(FrameKind::Inputs, {session, id, inputLayout.hash()},
                           inputLayout.partBorders(MaximumCyclicPayload));
    decoder = FrameDecoder(FrameKind::Outputs, {session, id, outputLayout.hash()},
                           outputLayout.partBorders(MaximumCyclicPayload));
    frames.assign(encoder.totalSize(), 0);
}

const PayloadLayout::Field *NodeSlot::firstNotFinite(const char *outputs) const noexcept
{
    for (const PayloadLayout::Field &field : outputLayout.fields()) {
        const char *bytes = outputs + field.offset;
        const bool finite = field.type.scalar() == QPlcSignalType::Real32 ? allFinite<float>(bytes, field.type.count())
            : field.type.scalar() == QPlcSignalType::Real64               ? allFinite<double>(bytes, field.type.count())
                                                                          : true;
        if (!finite)
            return &field;
    }
    return nullptr;
}

FrameCutter NodeSlot::outputCutter() const
{
    return {CyclicHeaderSize, &sizeOfOutputFrame, &decoder};
}

}  // namespace qplc
