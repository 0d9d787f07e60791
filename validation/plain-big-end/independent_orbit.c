/* The orbit of validation/plain-big-end without any code of this program.

     cc -O2 -o independent_orbit independent_orbit.c -lm
     ./independent_orbit 360 24 < ../../examples/02-big-end-diesel/loads.csv

   The arguments are the nodes around half the circumference and along half the width.

   With x = R phi, z = R zeta, phi from the narrowest gap and H = 1 - eps cos(phi), the film is
   div(H^3 grad P) = a eps sin(phi) - eps' cos(phi), p = 12 eta (R/C)^2 P, a = omega/2 - gamma',
   gamma the angle of the line of centres. It is linear in (a eps, eps') = m (cos alpha, sin alpha):
   the films of (1, 0), odd in phi, and (0, 1), even, are solved once for each eps, combined for each
   alpha, cut at zero (half Sommerfeld) and integrated. The table gives the direction of the force
   over alpha, and inverted the motion that answers a load. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NE = 260, NA = 361 };
static const double R = 0.036, B = 0.030, C = 36e-6, ETA = 0.008, RPM = 2000.0;
static double eps_of[NE], direction[NE][NA], log_size[NE][NA];
static double angle[800], load_x[800], load_y[800], speed[800];
static int rows;

/* The full film by finite differences, banded elimination without pivoting. */
static void solve(int n_phi, int n_zeta, double eps, int even, double *p) {
    double dp = M_PI / n_phi, dz = B / (2 * R) / n_zeta;
    int n = (n_phi + 1) * n_zeta, b = n_zeta, w = 2 * b + 1;
    double *band = calloc((size_t)n * w, sizeof *band), *r = calloc(n, sizeof *r);
    for (int i = 0; i <= n_phi; i++)
        for (int j = 0; j < n_zeta; j++) {
            int k = i * n_zeta + j;
            double f = i * dp, *a = band + (size_t)k * w + b;
            if (!even && (i == 0 || i == n_phi)) {
                a[0] = 1;
                continue;
            }
            double up = pow(1 - eps * cos(f + dp / 2), 3) / (dp * dp);
            double down = pow(1 - eps * cos(f - dp / 2), 3) / (dp * dp);
            double across = pow(1 - eps * cos(f), 3) / (dz * dz);
            if (i == 0) up *= 2, down = 0;
            if (i == n_phi) down *= 2, up = 0;
            if (i < n_phi) a[b] = up;
            if (i > 0) a[-b] = down;
            if (j > 0) a[-1] = across;
            if (j < n_zeta - 1) a[1] = across;
            /* No flow through the mid-plane; P = 0 at the end, half a step beyond the last node. */
            a[0] = -(up + down) - (j > 0 ? across : 0) - (j < n_zeta - 1 ? across : 2 * across);
            r[k] = even ? -cos(f) : sin(f);
        }
    for (int k = 0; k < n; k++)
        for (int m = 1; m <= b && k + m < n; m++) {
            double *a = band + (size_t)k * w + b, *c = band + (size_t)(k + m) * w + b;
            double q = c[-m] / a[0];
            if (q == 0) continue;
            for (int t = 1; t <= b; t++) c[t - m] -= q * a[t];
            r[k + m] -= q * r[k];
        }
    for (int k = n - 1; k >= 0; k--) {
        double *a = band + (size_t)k * w + b, s = r[k];
        for (int t = 1; t <= b && k + t < n; t++) s -= a[t] * p[k + t];
        p[k] = s / a[0];
    }
    free(band);
    free(r);
}

static void tabulate(int n_phi, int n_zeta) {
    size_t n = (size_t)(n_phi + 1) * n_zeta;
    double *odd = malloc(n * sizeof *odd), *even = malloc(n * sizeof *even);
    double cell = 2 * M_PI / n_phi * B / (2 * R) / n_zeta;
    for (int e = 0; e < NE; e++) {
        eps_of[e] = 1 - 0.95 * pow(0.012 / 0.95, e / (NE - 1.0));
        solve(n_phi, n_zeta, eps_of[e], 0, odd);
        solve(n_phi, n_zeta, eps_of[e], 1, even);
        for (int a = 0; a < NA; a++) {
            double alpha = 2 * M_PI * a / (NA - 1), along = 0, across = 0;
            for (int i = 0; i <= n_phi; i++)
                for (int j = 0; j < n_zeta; j++) {
                    int k = i * n_zeta + j;
                    double w = i == 0 || i == n_phi ? 0.5 : 1, f = i * M_PI / n_phi;
                    double o = cos(alpha) * odd[k], v = sin(alpha) * even[k];
                    double front = fmax(o + v, 0), back = fmax(v - o, 0);
                    along += w * (front + back) * cos(f);
                    across += w * (front - back) * sin(f);
                }
            double q = atan2(across, along);
            if (a) q += 2 * M_PI * round((direction[e][a - 1] - q) / (2 * M_PI));
            direction[e][a] = q;
            log_size[e][a] = log(cell * hypot(along, across));
        }
    }
    free(odd);
    free(even);
}

static void look_up(int e, double psi, double *alpha, double *size) {
    psi -= 2 * M_PI * floor((psi - direction[e][0]) / (2 * M_PI));
    int low = 0, high = NA - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (direction[e][middle] <= psi) low = middle; else high = middle;
    }
    double t = (psi - direction[e][low]) / (direction[e][high] - direction[e][low]);
    *alpha = 2 * M_PI * (low + t) / (NA - 1);
    *size = log_size[e][low] + t * (log_size[e][high] - log_size[e][low]);
}

/* Motion of the journal centre over the clearance, per degree of crank angle. */
static void motion(double degrees, const double q[2], double rate[2]) {
    double at = fmod(degrees, 720);
    int i = rows - 1;
    while (i > 0 && angle[i] > at) i--;
    int j = (i + 1) % rows;
    double t = (at - angle[i]) / ((j ? angle[j] : 720 + angle[0]) - angle[i]);
    double x = load_x[i] + t * (load_x[j] - load_x[i]), y = load_y[i] + t * (load_y[j] - load_y[i]);
    double omega = speed[i] + t * (speed[j] - speed[i]);
    double eps = hypot(q[0], q[1]), gamma = atan2(q[1], q[0]), psi = atan2(y, x) - gamma;
    double u = log((1 - eps) / (1 - eps_of[0])) / log((1 - eps_of[NE - 1]) / (1 - eps_of[0]));
    int e = (int)fmin(fmax(u * (NE - 1), 0), NE - 2);
    double s = u * (NE - 1) - e, a0, l0, a1, l1;
    look_up(e, psi, &a0, &l0);
    look_up(e + 1, psi, &a1, &l1);
    a1 += 2 * M_PI * round((a0 - a1) / (2 * M_PI));
    double alpha = a0 + s * (a1 - a0);
    double scale = 12 * ETA * (R / C) * (R / C) * R * R;
    double m = hypot(x, y) / (scale * exp(l0 + s * (l1 - l0)));
    double radial = m * sin(alpha), turning = omega / 2 * eps - m * cos(alpha);
    double seconds = 1 / (RPM / 60 * 360);
    rate[0] = (radial * cos(gamma) - turning * sin(gamma)) * seconds;
    rate[1] = (radial * sin(gamma) + turning * cos(gamma)) * seconds;
}

int main(int count, char **words) {
    char line[1000];
    if (count < 3) return 2;
    while (fgets(line, sizeof line, stdin))
        if (rows < 800 && sscanf(line, "%lf,%lf,%lf,%lf", angle + rows, load_x + rows,
                                 load_y + rows, speed + rows) == 4)
            rows++;
    tabulate(atoi(words[1]), atoi(words[2]));
    double q[2] = {-0.8, 0.3}, step = 0.02;
    for (int cycle = 1; cycle <= 3; cycle++) {
        double thinnest = INFINITY, when = 0;
        for (int i = 0; i < 36000; i++) {
            double k[4][2], at = i * step;
            motion(at, q, k[0]);
            for (int s = 1; s < 4; s++) {
                double h = s < 3 ? step / 2 : step;
                double trial[2] = {q[0] + h * k[s - 1][0], q[1] + h * k[s - 1][1]};
                motion(at + h, trial, k[s]);
            }
            for (int c = 0; c < 2; c++)
                q[c] += step / 6 * (k[0][c] + 2 * k[1][c] + 2 * k[2][c] + k[3][c]);
            double h = 1e6 * C * (1 - hypot(q[0], q[1]));
            if (h < thinnest) thinnest = h, when = at + step;
        }
        printf("cycle %d: minimum film %.4f um at %.2f deg\n", cycle, thinnest, when);
    }
    return 0;
}
