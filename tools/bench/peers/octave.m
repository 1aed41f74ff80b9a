% Octave's ode45 with events: the same modes, switches and rule for h = g = 0
% as the other event-driven peers. Prints the rows of harness.h; timed inside,
% so that the start of the interpreter does not count. Usage: octave.m PROBLEMS
%
% ode45 takes the place of an event off the straight line between two steps.
% That is not used: from the last step before the event a few steps of RK4 and
% Newton's rule go to the switch, or no tolerance would reach 1e-6.
1;

function g = rolling(k, y)
  g = (y(1) * y(3) + y(2) * k.cos) / k.sin;
end

function dg = rolling_rate(k, y, dy)
  dg = (dy(1) * y(3) + y(1) * dy(3) + dy(2) * k.cos) / k.sin;
end

function dy = rates(k, y, F, M)
  r = y(1);
  z = y(3);
  p = -(y(2) + r * z * k.cos) / k.sin;
  v = p + k.d * z;
  w = z + k.omega0 + k.alpha * y(4);
  Q_r = k.k2 * (k.r0 - r) - k.c2 * v + k.m * r * w * w;
  Q_phi = -k.c1 * w - 2 * k.m * r * w * v;
  dz = (Q_phi + k.d * Q_r + F * r * k.cos + M) / ...
       (k.m * (k.beta2 + r * r)) - k.alpha;
  dp = (Q_r + F * k.sin) / k.m + k.d * k.alpha;
  dy = [v; -k.sin * dp - k.cos * (v * z + r * dz); dz; 1];
end

function dy = slip_rates(k, side, roll, y)
  T = tan(k.a * (pi / 2 - atan2(side * y(2), roll * rolling(k, y))));
  dy = rates(k, y, side * k.mu * (4 / 3 - T / (18 * k.kappa)), ...
             side * roll * k.mu / 6 * T);
end

function [dy, lambda, A] = stick_rates(k, roll, y)
  spin = (y(1) * k.cos + roll * k.kappa) / (k.m * (k.beta2 + y(1)^2));
  A = k.sin^2 / k.m + k.cos * y(1) * spin;
  dy = rates(k, y, 0, 0);
  lambda = dy(2) / A;
  dy = [dy(1); 0; dy(3) + lambda * spin; 1];
end

function dy = contact_rates(k, side, roll, y)
  global calls
  calls += 1; % ode45 itself would go on for ever
  if calls > 40000 || ! all(abs(y) < 1e3), error('gave up'); end
  if side == 0
    dy = stick_rates(k, roll, y);
  else
    dy = slip_rates(k, side, roll, y);
  end
end

% The margins of a mode; it ends where one falls through zero.
function [value, stop, way] = margins(k, side, roll, y)
  g = rolling(k, y);
  if side == 0
    [~, lambda] = stick_rates(k, roll, y);
    value = [roll * g; k.mu - abs(lambda); 1];
  else
    value = [roll * g; side * y(2); hypot(y(2), g) - k.near];
  end
  stop = [1; 1; 1];
  way = [-1; -1; -1];
end

function y = rk4(f, y, t)
  k1 = f(y);
  k2 = f(y + t / 2 * k1);
  k3 = f(y + t / 2 * k2);
  k4 = f(y + t * k3);
  y += t / 6 * (k1 + 2 * (k2 + k3) + k4);
end

% From y, before the switch, onto it, about `guess` ahead. A guess that goes far
% past it leaves the range in the frozen field, and is halved.
function [y, t] = onto(k, side, roll, which, y, guess)
  f = @(x) contact_rates(k, side, roll, x);
  t = 0;
  step = guess;
  for i = 1:20
    try
      next = rk4(f, rk4(f, y, step / 2), step / 2);
      e = margins(k, side, roll, next)(which);
      tiny = 1e-7;
      slope = (margins(k, side, roll, next + tiny * f(next))(which) - e) / tiny;
    catch
      step /= 2;
      continue;
    end
    y = next;
    t += step;
    step = -e / slope;
    if abs(step) < 1e-13, break; end
  end
end

function [side, roll, y, fall, found] = capture(k, dy, fall, y)
  y = [y(1) + fall * dy(1); 0; 0; y(4) + fall];
  side = 0;
  for roll = [-1, 1]
    [dy, lambda, A] = stick_rates(k, roll, y);
    found = A > 0 && abs(lambda) <= k.mu && ...
            roll * rolling_rate(k, y, dy) > 0;
    if found, break; end
  end
end

function [y, steps, lost] = solve(k, tol)
  y = [k.r; k.h; k.omega - k.omega0; 0];
  t = 0;
  steps = 0;
  side = k.side;
  roll = sign(rolling(k, y));
  k.near = 0.1 * sqrt(tol);
  lost = true;
  for switches = 1:100
    % An event in the very first step does not stop ode45: that one is short.
    options = odeset('RelTol', tol, 'AbsTol', tol, 'Refine', 1, ...
                     'InitialStep', 1e-4, 'Events', ...
                     @(t, x) margins(k, side, roll, x));
    try
      [ts, ys, te, ~, ie] = ode45(@(t, x) contact_rates(k, side, roll, x), ...
                                  [t, k.t_end], y, options);
    catch
      return;
    end
    steps += numel(ts) - 1;
    if isempty(te) || ts(end) >= k.t_end
      y = ys(end, :)';
      lost = ts(end) < k.t_end;
      return;
    end
    [te, first] = min(te);
    which = ie(first);
    before = max(numel(ts) - 1, 1);
    try
      [y, gone] = onto(k, side, roll, which, ys(before, :)', te - ts(before));
    catch
      return;
    end
    t = ts(before) + gone;
    dy = contact_rates(k, side, roll, y);
    g = rolling(k, y);
    if side ~= 0 && which == 1
      roll = sign(rolling_rate(k, y, dy));
      y(3) = -y(2) * k.cos / y(1);
    elseif side ~= 0 && which == 2
      y(2) = 0;
      [~, lambda, A] = stick_rates(k, roll, y);
      if A > 0 && abs(lambda) <= k.mu, side = 0; else, side = -side; end
    elseif side == 0 && which == 2
      [~, lambda] = stick_rates(k, roll, y);
      side = sign(lambda);
    else
      if side == 0
        fall = 0;
      else
        fall = -(y(2)^2 + g^2) / (y(2) * dy(2) + g * rolling_rate(k, y, dy));
      end
      [side, roll, y, fall, found] = capture(k, dy, fall, y);
      t += fall;
      if ! found, return; end
    end
  end
end

function k = complete(k)
  k.gamma = -3 * pi / 4;
  k.sin = sin(k.gamma);
  k.cos = cos(k.gamma);
  k.beta2 = k.beta^2;
  k.a = 2 / pi * atan(6 * k.kappa);
end

warning('off', 'all');
table = load(argv(){end});
file = fopen(argv(){end});
names = strsplit(strtrim(fgetl(file)(2:end)), ' ');
fclose(file);
fields = {'r', 'omega', 'h', 'side', 't_end', 'm', 'd', 'beta', 'k2', 'c1', ...
          'c2', 'r0', 'omega0', 'mu', 'kappa', 'gamma', 'alpha', 'end_r', 'end_v', ...
          'end_w', 'branch_error'};
% The rates of the reference at random states (check.c).
global calls
for row = load([argv(){end} '.states'])'
  k = complete(cell2struct(num2cell(table(row(1), :)), fields, 2));
  calls = 0;
  dy = contact_rates(k, row(6), row(7), row(2:5));
  if norm(dy(1:3) - row(8:10)) > 1e-11, error('not the equations'); end
end
factor = 10^0.75;
rand('twister', 20240607);
for tol = 1e-3 * factor.^-(0:12)
  shifted = tol * factor^(rand() - 0.5);
  for i = 1:numel(names)
    k = cell2struct(num2cell(table(i, :)), fields, 2);
    calls = 0;
    tic;
    k = complete(k);
    [y, steps, lost] = solve(k, shifted);
    time = toc;
    z = y(3);
    x = [y(1), -(y(2) + y(1) * z * k.cos) / k.sin + k.d * z, ...
         z + k.omega0 + k.alpha * y(4)];
    e = max(abs(x - [k.end_r, k.end_v, k.end_w]));
    verdict = 'ok';
    if lost || isnan(e)
      e = Inf;
      verdict = 'refused';
    elseif e > k.branch_error
      verdict = 'branch';
    end
    printf('%s,octave-ode45,tol=%.3e,%.3e,%.0f,%s\n', names{i}, shifted, e, ...
           1e9 * time, verdict);
  end
end
