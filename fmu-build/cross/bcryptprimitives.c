/* Stands in for Windows' bcryptprimitives.dll where wine is older than 9.0 and lacks it. Rust's standard library takes from
   it the seeds of its hash tables. Part of the test under wine alone; Windows has its own and the FMU holds none. */
#include <windows.h>

BOOLEAN NTAPI SystemFunction036(PVOID data, ULONG length); /* RtlGenRandom */

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T length)
{
    return SystemFunction036(data, (ULONG)length);
}
