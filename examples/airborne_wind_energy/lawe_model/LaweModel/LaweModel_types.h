/* SPDX-License-Identifier: Apache-2.0 */
#ifndef RTW_HEADER_LaweModel_types_h_
#define RTW_HEADER_LaweModel_types_h_

/* Parameters (default storage) */
typedef struct P_LaweModel_T_ P_LaweModel_T;

/* Forward declaration for rtModel */
typedef struct tag_RTM_LaweModel_T RT_MODEL_LaweModel_T;

#endif
